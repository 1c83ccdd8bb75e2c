#pragma once

#include <optional>
#include <span>
#include <vector>

#include "adit/survey/wall_chains.hpp"
#include "adit/survey/walls.hpp"

namespace adit {

/// Where straight pieces begin in a row of points: the first index of each, ascending from 0.
///
/// The fewest pieces whose points all lie within `tolerance_m` of their line, and among these the
/// best fit (dynamic programming over all breaks; a piece costs as much as a metre of points that
/// lie the tolerance off). Pieces have two points at least.
std::vector<std::size_t> split_into_lines(std::span<const Vector2d> points, double spacing_m,
                                          double tolerance_m);

/// The vertices of the line of straight pieces that fits the points best, one for each begin and
/// one for the end; a closed line's last equals its first. They start where neighbouring pieces
/// meet and are moved together to the least squares of all points (Gauss-Newton).
std::vector<Vector2d> fit_vertices(std::span<const Vector2d> points,
                                   std::span<const std::size_t> begins, bool closed,
                                   double corner_reach_m);

/// Makes the covariances of a line's vertices from those of its pieces, anew.
void set_vertex_covariances(SurveyedWallLine& line);

/// The chain as a line of walls; nothing where too little speaks for it.
std::optional<SurveyedWallLine> make_wall_line(std::span<const WallNode> nodes,
                                               const WallChain& chain, const WallOptions& options);

}  // namespace adit
