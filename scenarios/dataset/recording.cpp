#include "scenarios/dataset/recording.h"

namespace alula::scenarios::dataset {

std::vector<base::Time> StampsOf(const std::vector<ImageFile>& images) {
  std::vector<base::Time> stamps;
  for (const ImageFile& image : images) stamps.push_back(image.captured);
  return stamps;
}

std::vector<base::StampedPose> TrueTrajectory(const Recording& recording) {
  std::vector<base::StampedPose> poses;
  for (const BodyTruth& truth : recording.truth) poses.push_back({.time = truth.time, .X_FS = truth.X_WB});
  return poses;
}

}  // namespace alula::scenarios::dataset
