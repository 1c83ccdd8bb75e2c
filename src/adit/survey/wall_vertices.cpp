#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>

#include "adit/geometry/moments.hpp"
#include "adit/survey/wall_polyline.hpp"

namespace adit {
namespace {

constexpr int kSteps = 3;
constexpr double kStay = 1e-2;      // weight of a vertex' place against one point's distance
constexpr double kParallel = 0.17;  // sine: flatter lines meet anywhere

/// The line through the points of one piece.
struct PieceLine {
  Vector2d point;
  Vector2d direction;

  Vector2d project(const Vector2d& p) const { return point + direction * direction.dot(p - point); }
};

PieceLine line_through(std::span<const Vector2d> points) {
  Moments moments;
  for (const Vector2d& p : points) moments.add((p - points[0]).x(), (p - points[0]).y());
  if (points.size() < 2) return {points[0], Vector2d::UnitX()};
  const LineFit fit = fit_line(moments);
  return {fit.centroid + points[0], fit.direction};
}

/// Where two pieces meet, for points `end` and `begin` next to the break.
Vector2d meeting(const PieceLine& a, const PieceLine& b, const Vector2d& end, const Vector2d& begin,
                 double reach) {
  const Vector2d middle = 0.5 * (end + begin);
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) > kParallel) {
    const double along = cross(b.point - a.point, b.direction) / sine;
    Vector2d at = a.point + along * a.direction;
    if ((at - middle).norm() <= reach) return at;
  }
  return 0.5 * (a.project(middle) + b.project(middle));
}

struct Layout {
  std::span<const Vector2d> points;
  std::span<const std::size_t> begins;
  bool closed = false;

  std::size_t pieces() const { return begins.size(); }
  std::size_t end_of(std::size_t piece) const {
    return piece + 1 < begins.size() ? begins[piece + 1] : points.size();
  }
  std::span<const Vector2d> of(std::size_t piece) const {
    return points.subspan(begins[piece], end_of(piece) - begins[piece]);
  }
  std::size_t unknowns() const { return closed ? pieces() : pieces() + 1; }
  std::size_t vertex_after(std::size_t piece) const { return (piece + 1) % unknowns(); }
};

std::vector<Vector2d> first_vertices(const Layout& layout, double reach) {
  std::vector<PieceLine> lines;
  for (std::size_t i = 0; i < layout.pieces(); ++i) lines.push_back(line_through(layout.of(i)));
  std::vector<Vector2d> vertices(layout.unknowns());
  for (std::size_t i = 0; i + 1 < layout.pieces(); ++i) {
    vertices[i + 1] =
        meeting(lines[i], lines[i + 1], layout.of(i).back(), layout.of(i + 1).front(), reach);
  }
  if (layout.closed) {
    vertices[0] = meeting(lines.back(), lines[0], layout.points.back(), layout.points[0], reach);
  } else {
    vertices.front() = lines.front().project(layout.points.front());
    vertices.back() = lines.back().project(layout.points.back());
  }
  return vertices;
}

class NormalEquations {
 public:
  explicit NormalEquations(std::size_t vertices)
      : size_(static_cast<Eigen::Index>(2 * vertices)), right_(Eigen::VectorXd::Zero(size_)) {
    for (Eigen::Index i = 0; i < size_; ++i) entries_.emplace_back(i, i, kStay);
  }

  /// A residual and its gradient over two vertices.
  void add(std::size_t a, const Vector2d& gradient_a, std::size_t b, const Vector2d& gradient_b,
           double residual) {
    const Eigen::Index at[4] = {index(a), index(a) + 1, index(b), index(b) + 1};
    const double g[4] = {gradient_a.x(), gradient_a.y(), gradient_b.x(), gradient_b.y()};
    for (int i = 0; i < 4; ++i) {
      right_[at[i]] -= g[i] * residual;
      for (int j = 0; j < 4; ++j) entries_.emplace_back(at[i], at[j], g[i] * g[j]);
    }
  }

  Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_);
  }

 private:
  static Eigen::Index index(std::size_t vertex) { return static_cast<Eigen::Index>(2 * vertex); }

  Eigen::Index size_;
  Eigen::VectorXd right_;
  std::vector<Eigen::Triplet<double>> entries_;
};

/// Holds the vertex after a piece along the wall to where the points pass from this piece to the
/// next, by as much as one point: pieces that meet at a flat angle do not tell where they meet, and
/// the vertex would slide away from its points.
void hold_at_break(const Layout& layout, std::size_t piece, std::span<const Vector2d> vertices,
                   NormalEquations& equations) {
  const Vector2d& end = layout.of(piece).back();
  const Vector2d& begin = layout.of((piece + 1) % layout.pieces()).front();
  const Vector2d way = begin - end;
  if (way.squaredNorm() < 1e-12) return;
  const Vector2d along = way.normalized();
  const std::size_t vertex = layout.vertex_after(piece);
  const double residual = along.dot(0.5 * (end + begin) - vertices[vertex]);
  equations.add(vertex, -along, vertex, Vector2d::Zero(), residual);
}

void improve(const Layout& layout, std::vector<Vector2d>& vertices) {
  NormalEquations equations(vertices.size());
  for (std::size_t piece = 0; piece < layout.pieces(); ++piece) {
    const std::size_t a = piece;
    const std::size_t b = layout.vertex_after(piece);
    const Vector2d along = vertices[b] - vertices[a];
    const double squared = along.squaredNorm();
    if (a == b || squared < 1e-12) continue;
    const Vector2d normal = perpendicular(along) / std::sqrt(squared);
    for (const Vector2d& p : layout.of(piece)) {
      const double u = std::clamp((p - vertices[a]).dot(along) / squared, 0.0, 1.0);
      equations.add(a, -(1.0 - u) * normal, b, -u * normal, normal.dot(p - vertices[a]));
    }
  }
  const std::size_t breaks = layout.closed ? layout.pieces() : layout.pieces() - 1;
  for (std::size_t piece = 0; piece < breaks; ++piece) {
    hold_at_break(layout, piece, vertices, equations);
  }
  const Eigen::VectorXd step = equations.solve();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] += step.segment<2>(static_cast<Eigen::Index>(2 * i));
  }
}

}  // namespace

std::vector<Vector2d> fit_vertices(std::span<const Vector2d> points,
                                   std::span<const std::size_t> begins, bool closed,
                                   double corner_reach_m) {
  const Layout layout{points, begins, closed && begins.size() > 2};
  std::vector<Vector2d> vertices = first_vertices(layout, corner_reach_m);
  for (int i = 0; i < kSteps; ++i) improve(layout, vertices);
  if (layout.closed) vertices.push_back(vertices.front());
  return vertices;
}

}  // namespace adit
