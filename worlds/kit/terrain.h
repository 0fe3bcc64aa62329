#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/random.h"
#include "worlds/kit/surface.h"
#include "worlds/world.h"

namespace alula::worlds {

/// Heights over a lattice of the horizontal plane; between its points lie two triangles a cell, split along the
/// diagonal from (i, j) to (i + 1, j + 1): what is seen and hit is exactly what HeightAt says.
struct HeightField {
  base::Vec2 low{0.0, 0.0};  // of the point (0, 0), m
  double cell = 1.0;         // m
  int columns = 0;           // points along x
  int rows = 0;              // points along y
  std::vector<float> z;      // m, row by row

  float& At(int i, int j) {
    return z[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
  }
  float At(int i, int j) const {
    return z[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
  }
  base::Vec2 Point(int i, int j) const { return low + cell * base::Vec2(i, j); }
};

/// Flat at z = 0: a square of this side about the origin.
HeightField FlatField(double side, double cell);

/// Adds hills: a sum of octaves of gradient noise (Perlin 1985), the coarsest of this wavelength, each next one half of
/// it and `persistence` as high. `height`: standard deviation of the sum, m, about.
struct HillsConfig {
  double height = 0.5;       // m
  double wavelength = 30.0;  // m
  double persistence = 0.45;
  int octaves = 4;
};
void AddHills(HeightField& field, const HillsConfig& config, base::RandomStream& random);

/// Blends towards height `z` inside `radius` of p, over `rim` more metres: for a pad, a house, a road.
void Level(HeightField& field, const base::Vec2& p, double radius, double rim, double z);

/// Height of the surface at p, m; p is held within the field.
double HeightAt(const HeightField& field, const base::Vec2& p);
/// Unit normal of the triangle under p.
base::Vec3 NormalAt(const HeightField& field, const base::Vec2& p);

/// Cuts the field into tiles "<name>/<column>_<row>" of one texture period a side (the surface's own) and adds each as
/// a mesh of class kGround that collides; neighbours share their border's points and normals, so that no seam shows.
/// The period must be a multiple of the cell. Variants are drawn from `random`.
void AddTerrain(World& world, const std::string& name, const HeightField& field, const Surface& surface,
                base::RandomStream& random);

}  // namespace alula::worlds
