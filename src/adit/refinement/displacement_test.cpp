#include "adit/refinement/displacement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adit/simulation/random.hpp"

namespace adit {
namespace {

constexpr double kWallX = 5.0;
constexpr double kMapSigma = 0.02;

const DisplacementOptions kOptions{.least_length_m = 1.5, .most_m = 2.5, .roughness_ratio = 1.5};

ScannerModel scanner() {
  ScannerModel model;
  model.range_sigma_m = 0.02;
  model.quantisation_m = 0.0;
  return model;
}

struct Beams {
  std::vector<BeamResidual> beams;
  std::vector<double> on_wall;

  double displacement() const {
    return largest_displacement(beams, on_wall, scanner(), kMapSigma, kOptions);
  }
};

/// Beams from the origin to what stands so far before the wall x = 5, from y to y, aside of the map
/// wherever that is more than a hand's breadth.
void add_stretch(double before, double from_y, double to_y, Beams& all, double rough_m = 0.02) {
  Random random(1);
  for (double bearing = -1.2; bearing < 1.2; bearing += 0.01) {
    const double x = kWallX - before - rough_m * random.normal();
    const double y = x * std::tan(bearing);
    if (y < from_y || y > to_y) continue;
    BeamResidual beam;
    beam.gradient.setZero();
    beam.wall = 3;
    beam.has_return = true;
    beam.normal = -Vector2d::UnitX();
    beam.direction = unit_vector(bearing);
    beam.stretch = -1.0 / std::cos(bearing);
    beam.range = kWallX / std::cos(bearing);
    beam.hit = beam.range * beam.direction;
    beam.residual = (x - kWallX) / std::cos(bearing);
    all.beams.push_back(beam);
    all.on_wall.push_back(std::abs(before) > 0.1 ? 0.01 : 0.99);
  }
}

Beams stretch(double before, double from_y, double to_y, double rough_m = 0.02) {
  Beams all;
  add_stretch(before, from_y, to_y, all, rough_m);
  return all;
}

TEST(Displacement, IsHowFarAStretchLiesFromItsWall) {
  EXPECT_NEAR(stretch(0.8, -2.0, 2.0).displacement(), 0.8, 0.02);
  EXPECT_NEAR(stretch(-0.8, -2.0, 2.0).displacement(), 0.8, 0.02);
  EXPECT_NEAR(stretch(0.4, 3.0, 6.0).displacement(), 0.4, 0.02);
}

TEST(Displacement, IsNoneWhereTheBeamsAreOnTheWall) {
  EXPECT_EQ(stretch(0.0, -2.0, 2.0).displacement(), 0.0);
  EXPECT_EQ(Beams{}.displacement(), 0.0);
}

TEST(Displacement, AShortOrRoughOrFarStretchIsNoWall) {
  EXPECT_EQ(stretch(0.8, -0.7, 0.7).displacement(), 0.0);
  EXPECT_GT(stretch(0.8, -0.8, 0.8).displacement(), 0.0);
  EXPECT_EQ(stretch(0.8, -2.0, 2.0, 0.1).displacement(), 0.0);
  EXPECT_EQ(stretch(2.6, -2.0, 2.0).displacement(), 0.0);
  EXPECT_GT(stretch(2.4, -2.0, 2.0).displacement(), 0.0);
}

TEST(Displacement, PiecesFarApartAreNotOneStretch) {
  Beams pieces = stretch(0.8, -2.2, -1.2);
  add_stretch(0.8, 1.2, 2.2, pieces);
  EXPECT_EQ(pieces.displacement(), 0.0);
}

TEST(Displacement, BeamsOfAnotherWallAreAnotherStretch) {
  Beams pieces = stretch(0.8, -1.0, 1.0);
  for (std::size_t i = 0; i < pieces.beams.size() / 2; ++i) pieces.beams[i].wall = 4;
  EXPECT_EQ(pieces.displacement(), 0.0);
}

TEST(Displacement, IsTheLargestOfAll) {
  Beams all = stretch(0.4, -5.0, -2.0);
  add_stretch(1.1, -1.0, 1.0, all);
  add_stretch(0.7, 2.0, 5.0, all);
  EXPECT_NEAR(all.displacement(), 1.1, 0.02);
}

TEST(Displacement, BeamsWithoutReturnSayNothing) {
  Beams all = stretch(0.8, -2.0, 2.0);
  for (BeamResidual& beam : all.beams) beam.has_return = false;
  EXPECT_EQ(all.displacement(), 0.0);
}

TEST(Displacement, CountsForSomeWay) {
  DisplacementOptions options;
  options.kept_m = 16.0;
  RecentDisplacement recent;
  EXPECT_EQ(recent.largest(), 0.0);
  recent.see(0.9);
  recent.drive(15.0, options);
  recent.see(0.5);
  EXPECT_EQ(recent.largest(), 0.9);
  recent.drive(2.0, options);
  EXPECT_EQ(recent.largest(), 0.5);  // what is smaller counts as long
  recent.drive(13.0, options);
  EXPECT_EQ(recent.largest(), 0.5);
  recent.drive(2.0, options);
  EXPECT_EQ(recent.largest(), 0.0);
}

TEST(Displacement, CountsForAllOfTheWayInSmallStepsAndNotBeyondALongOne) {
  DisplacementOptions options;
  options.kept_m = 16.0;
  RecentDisplacement recent;
  recent.see(0.7);
  for (int i = 0; i < 159; ++i) {
    recent.drive(0.1, options);
    recent.see(0.1);
    EXPECT_EQ(recent.largest(), 0.7) << i;
  }
  for (int i = 0; i < 10; ++i) recent.drive(0.1, options);
  EXPECT_EQ(recent.largest(), 0.1);
  recent.see(0.7);
  recent.drive(1e9, options);
  EXPECT_EQ(recent.largest(), 0.0);
}

}  // namespace
}  // namespace adit
