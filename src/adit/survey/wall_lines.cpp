#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr double kIndependentM = 1.0;  // m of wall whose roughness hangs together
constexpr double kStrayOfTolerance =
    4.0;                            // end pieces shorter than this many tolerances are strays
constexpr double kLeastSure = 0.3;  // share of a piece that is no roof for certain
constexpr double kLooseEnd = 0.1;   // m, one sigma: where along itself a wall ends

std::vector<Vector2d> points_of(std::span<const WallNode> nodes, std::span<const int> chain) {
  std::vector<Vector2d> points;
  for (const int i : chain) points.push_back(nodes[static_cast<std::size_t>(i)].point);
  return points;
}

/// Turns a closed chain so that it begins where two pieces meet.
void begin_at_break(std::span<const WallNode> nodes, const WallOptions& options,
                    std::vector<int>& chain) {
  const std::vector<Vector2d> points = points_of(nodes, chain);
  const auto begins = split_into_lines(points, node_spacing(options), options.tolerance_m);
  const auto middle = static_cast<std::ptrdiff_t>(begins[begins.size() / 2]);
  std::rotate(chain.begin(), chain.begin() + middle, chain.end());
}

/// Covariance of the line of a piece over (displacement, turn): what the visits' poses err, and
/// what the wall's roughness leaves of a mean over independent stretches of it.
Matrix2d line_covariance(std::span<const WallNode> nodes, std::span<const int> chain, double length,
                         double misfit, double& scatter) {
  double information = 0.0;
  double visits = 0.0;
  scatter = misfit;
  for (const int i : chain) {
    const WallNode& node = nodes[static_cast<std::size_t>(i)];
    information += node.visit_information;
    visits += node.visits;
    scatter += node.scatter;
  }
  const auto count = static_cast<double>(chain.size());
  information = std::max(information / count, 1e-9);
  visits = std::max(visits / count, 1.0);
  scatter /= count;
  const double stretches = std::max(1.0, length / kIndependentM);
  const double offset = 1.0 / (information * visits) + scatter / (visits * stretches);
  const double arm = std::max(length, 0.1);
  Matrix2d covariance = Matrix2d::Zero();
  covariance(0, 0) = offset;
  covariance(1, 1) = 12.0 * offset / (arm * arm);
  return covariance;
}

SurveyedWall make_piece(std::span<const WallNode> nodes, std::span<const int> chain,
                        const Segment& segment) {
  SurveyedWall piece;
  piece.segment = segment;
  double misfit = 0.0;
  for (const int i : chain) {
    const WallNode& node = nodes[static_cast<std::size_t>(i)];
    const double d = distance(segment, node.point);
    misfit += d * d;
    piece.support.hits += node.hits;
    if (node.sure) piece.support.sure += 1.0 / static_cast<double>(chain.size());
    piece.support.scans = std::max(piece.support.scans, node.scans);
    piece.support.visits = std::max(piece.support.visits, node.visits);
  }
  double scatter = 0.0;
  piece.covariance = line_covariance(nodes, chain, segment.length(), misfit, scatter);
  piece.scatter_m = std::sqrt(scatter);
  return piece;
}

Matrix2d information_of(const SurveyedWall& piece, const Vector2d& vertex) {
  const Vector2d along = (piece.segment.b - piece.segment.a).normalized();
  const Vector2d normal = perpendicular(along);
  const double arm = along.dot(vertex - 0.5 * (piece.segment.a + piece.segment.b));
  const double variance = piece.covariance(0, 0) + arm * arm * piece.covariance(1, 1);
  return normal * normal.transpose() / variance;
}

/// Drops what a chain took along at the ends of an open line: short strays, and what may be roof
/// or floor. The last piece of all stays where it is none.
void trim_ends(SurveyedWallLine& line, double shortest) {
  if (line.closed) return;
  const auto is_stray = [&](const SurveyedWall& piece) {
    if (piece.support.sure < kLeastSure) return true;
    return line.pieces.size() > 1 && piece.segment.length() < shortest;
  };
  while (!line.pieces.empty() && is_stray(line.pieces.back())) {
    line.pieces.pop_back();
    line.vertices.pop_back();
  }
  while (!line.pieces.empty() && is_stray(line.pieces.front())) {
    line.pieces.erase(line.pieces.begin());
    line.vertices.erase(line.vertices.begin());
  }
}

/// Greatest distance from the first vertex, or from the one that is farthest from it.
double extent(const SurveyedWallLine& line) {
  const auto farthest_from = [&](const Vector2d& p) {
    return *std::max_element(line.vertices.begin(), line.vertices.end(),
                             [&](const Vector2d& a, const Vector2d& b) {
                               return (a - p).squaredNorm() < (b - p).squaredNorm();
                             });
  };
  const Vector2d one = farthest_from(line.vertices.front());
  return (farthest_from(one) - one).norm();
}

bool is_supported(const SurveyedWallLine& line, const WallOptions& options) {
  double hits = 0.0;
  for (const SurveyedWall& piece : line.pieces) hits += piece.support.hits;
  const double length = line.length();
  return extent(line) >= options.min_length_m && hits >= options.min_hits_per_m * length;
}

/// Pieces of straight wall along a row of points.
struct FittedPieces {
  std::vector<std::size_t> begins;
  std::vector<Vector2d> vertices;
  bool closed = false;

  std::size_t end_of(std::size_t piece, std::size_t points) const {
    return piece + 1 < begins.size() ? begins[piece + 1] : points;
  }
};

/// Distance from a piece, or from the one before or after: about a corner a point may lie by
/// either.
double distance_about(const FittedPieces& fitted, std::size_t piece, const Vector2d& point) {
  const std::size_t pieces = fitted.begins.size();
  double least = std::numeric_limits<double>::max();
  for (const std::size_t i : {piece + pieces - 1, piece, piece + 1}) {
    const std::size_t k = i % pieces;
    const bool is_beside = fitted.closed || (k + 1 >= piece && k <= piece + 1);
    if (!is_beside) continue;
    least = std::min(least, distance({fitted.vertices[k], fitted.vertices[k + 1]}, point));
  }
  return least;
}

/// How many points a piece has at the least that is not taken for a stray: more at the open end of
/// a line.
std::size_t least_points(const WallOptions& options, bool at_end) {
  constexpr std::size_t kLeast = 2;
  const double stray = kStrayOfTolerance * options.tolerance_m;
  return at_end ? kLeast + static_cast<std::size_t>(stray / node_spacing(options)) : kLeast;
}

/// The point of a piece that is farthest from the walls, if that is more than the tolerance and
/// the piece can be broken there; else nothing.
std::optional<std::size_t> stray(std::span<const Vector2d> points, const FittedPieces& fitted,
                                 std::size_t piece, const WallOptions& options) {
  const std::size_t begin = fitted.begins[piece];
  const std::size_t end = fitted.end_of(piece, points.size());
  const std::size_t before = least_points(options, !fitted.closed && piece == 0);
  const std::size_t after = least_points(options, !fitted.closed && end == points.size());
  if (end - begin < before + after) return std::nullopt;
  std::optional<std::size_t> farthest;
  double most = options.tolerance_m;
  for (std::size_t i = begin; i < end; ++i) {
    const double d = distance_about(fitted, piece, points[i]);
    if (d <= most) continue;
    most = d;
    farthest = i;
  }
  if (!farthest) return std::nullopt;
  return std::clamp(*farthest, begin + before, end - after);
}

/// Pieces that follow the points to within the tolerance. Vertices that two pieces share may draw
/// a piece off the line that fits it alone; such a piece is broken once more.
FittedPieces fit_pieces(std::span<const Vector2d> points, bool closed, const WallOptions& options) {
  FittedPieces fitted;
  fitted.begins = split_into_lines(points, node_spacing(options), options.tolerance_m);
  for (bool strays = true; strays;) {
    strays = false;
    fitted.closed = closed && fitted.begins.size() > 2;
    fitted.vertices = fit_vertices(points, fitted.begins, fitted.closed, options.corner_gap_m);
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < fitted.begins.size(); ++i) {
      begins.push_back(fitted.begins[i]);
      const auto at = stray(points, fitted, i, options);
      if (!at) continue;
      begins.push_back(*at);
      strays = true;
    }
    if (strays) fitted.begins = std::move(begins);
  }
  return fitted;
}

}  // namespace

void set_vertex_covariances(SurveyedWallLine& line) {
  const std::size_t pieces = line.pieces.size();
  line.covariances.clear();
  for (std::size_t v = 0; v < line.vertices.size(); ++v) {
    Matrix2d information = Matrix2d::Identity() / (kLooseEnd * kLooseEnd);
    if (v > 0 || line.closed) {
      information += information_of(line.pieces[(v + pieces - 1) % pieces], line.vertices[v]);
    }
    if (v < pieces || line.closed) {
      information += information_of(line.pieces[v % pieces], line.vertices[v]);
    }
    line.covariances.push_back(information.inverse());
  }
}

double SurveyedWallLine::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < vertices.size(); ++i) sum += (vertices[i] - vertices[i - 1]).norm();
  return sum;
}

std::optional<SurveyedWallLine> make_wall_line(std::span<const WallNode> nodes,
                                               const WallChain& chain, const WallOptions& options) {
  std::vector<int> order = chain.nodes;
  if (static_cast<double>(order.size()) * node_spacing(options) < 0.5 * options.min_length_m)
    return std::nullopt;
  if (order.size() < 2) return std::nullopt;
  if (chain.closed) begin_at_break(nodes, options, order);
  const std::vector<Vector2d> points = points_of(nodes, order);
  FittedPieces fitted = fit_pieces(points, chain.closed, options);
  const std::vector<std::size_t>& begins = fitted.begins;
  SurveyedWallLine line;
  line.closed = fitted.closed;
  line.vertices = std::move(fitted.vertices);
  for (std::size_t i = 0; i < begins.size(); ++i) {
    const std::size_t end = fitted.end_of(i, order.size());
    line.pieces.push_back(
        make_piece(nodes, std::span<const int>(order).subspan(begins[i], end - begins[i]),
                   {line.vertices[i], line.vertices[i + 1]}));
  }
  trim_ends(line, kStrayOfTolerance * options.tolerance_m);
  if (line.pieces.empty() || !is_supported(line, options)) return std::nullopt;
  set_vertex_covariances(line);
  return line;
}

}  // namespace adit
