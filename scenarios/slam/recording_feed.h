#pragma once

#include <functional>
#include <vector>

#include "scenarios/dataset/recording.h"
#include "scenarios/slam/estimator_run.h"

namespace alula::scenarios::slam {

/// Hands a recording's frames to estimators, each image read once. `progress` is told the
/// time of the recording, whole tenths of a second. Stamps are counted from the recording's first image. The start is
/// that of the truth where there is one, else the origin.
std::vector<EstimatorResult> FeedRecording(const dataset::Recording& recording, const std::vector<Variant>& variants,
                                           const std::function<void(base::Time)>& progress);

/// From the first to the last image.
base::Duration SpanOf(const dataset::Recording& recording);

/// What is true of a recording, on the estimators' clock.
std::vector<base::StampedPose> TruthOf(const dataset::Recording& recording);

}  // namespace alula::scenarios::slam
