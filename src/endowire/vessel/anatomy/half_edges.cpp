#include "endowire/vessel/anatomy/half_edges.hpp"

#include <algorithm>

#include "endowire/base/contract.hpp"

namespace endowire::vessel::anatomy {

using Index = HalfEdges::Index;

HalfEdges::HalfEdges(const TriangleMesh& mesh) : leaving_(mesh.vertices_mm.size(), none) {
  for (const auto& t : mesh.triangles) corner_.insert(corner_.end(), t.begin(), t.end());
  opposite_.assign(corner_.size(), none);
  struct Edge {
    Index low, high, half;
  };
  std::vector<Edge> edges;
  edges.reserve(corner_.size());
  for (Index h = 0; h < count(); ++h)
    edges.push_back({std::min(from(h), to(h)), std::max(from(h), to(h)), h});
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.half < b.half;
  });
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].low != edges[i + 1].low || edges[i].high != edges[i + 1].high) continue;
    ENDOWIRE_EXPECTS(
        i + 2 >= edges.size() || edges[i + 2].low != edges[i].low || edges[i + 2].high != edges[i].high,
        "an edge has at most two triangles");
    glue(edges[i].half, edges[i + 1].half);
  }
  for (Index h = 0; h < count(); ++h) set_leaving(from(h), h);
}

void HalfEdges::glue(Index a, Index b) {
  if (a != none) opposite_[at(a)] = b;
  if (b != none) opposite_[at(b)] = a;
}

/// A border half-edge wins, so that `around` sees the whole fan.
void HalfEdges::set_leaving(Index v, Index h) {
  if (leaving_[at(v)] == none || opposite_[at(h)] == none) leaving_[at(v)] = h;
}

int HalfEdges::triangles_at(Index v) const {
  int count = 0;
  around(v, [&](Index /*h*/) { ++count; });
  return count;
}

bool HalfEdges::joined(Index a, Index b) const {
  bool found = false;
  around(a, [&](Index h) { found = found || to(h) == b || apex(h) == b; });
  return found;
}

Index HalfEdges::split(Index h) {
  const Index o = opposite(h);
  const auto middle = static_cast<Index>(leaving_.size());
  leaving_.push_back(none);
  // Triangle (a, b, c) with h = a → b becomes (a, m, c) and the new (m, b, c).
  const auto halve = [&](Index half) {
    const Index b = to(half);
    const Index c = apex(half);
    const Index far = next(half);
    const Index beyond = opposite(far);
    const Index fresh = count();
    corner_.insert(corner_.end(), {middle, b, c});
    opposite_.insert(opposite_.end(), 3, none);
    corner_[at(far)] = middle;
    glue(fresh + 1, beyond);
    glue(fresh + 2, far);
    if (leaving_[at(b)] == far) leaving_[at(b)] = fresh + 1;
    return fresh;
  };
  const Index behind = halve(h);
  if (o == none) {
    leaving_[at(middle)] = behind;  // along the border
  } else {
    const Index other = halve(o);
    // h is a → m, behind m → b; o is b → m, other m → a.
    glue(h, other);
    glue(behind, o);
    leaving_[at(middle)] = behind;
  }
  return middle;
}

bool HalfEdges::may_collapse(Index h) const {
  const Index a = from(h);
  const Index b = to(h);
  const Index o = opposite(h);
  if (on_border(a) && on_border(b) && o != none) return false;
  if (on_border(b) && !on_border(a)) return false;
  // Link condition: a and b share only the corners opposite to the edge.
  int shared = 0;
  around(a, [&](Index leaving) {
    const Index v = to(leaving);
    if (v != b && joined(b, v)) ++shared;
    if (opposite(previous(leaving)) == none && apex(leaving) != b && joined(b, apex(leaving))) ++shared;
  });
  if (shared != (o == none ? 1 : 2)) return false;
  // The corners opposite to the edge lose a triangle; a border loop keeps at least four edges by its spacing.
  const auto enough = [&](Index v) { return triangles_at(v) > (on_border(v) ? 2 : 4); };
  return enough(apex(h)) && (o == none || enough(apex(o)));
}

void HalfEdges::collapse(Index h) {
  const Index a = from(h);
  const Index b = to(h);
  const Index o = opposite(h);
  std::vector<Index> moved;
  around(b, [&](Index leaving) { moved.push_back(leaving); });
  for (Index leaving : moved) corner_[at(leaving)] = a;
  std::vector<Index> touched{a};
  const auto remove = [&](Index half) {
    const Index c = apex(half);
    const Index outer = opposite(next(half));
    const Index inner = opposite(previous(half));
    glue(outer, inner);
    touched.push_back(c);
    for (Index k : {half, next(half), previous(half)}) corner_[at(k)] = opposite_[at(k)] = none;
    return std::array<Index, 2>{outer, inner};
  };
  std::vector<Index> seeds;
  for (Index half : {h, o}) {
    if (half == none) continue;
    for (Index k : remove(half))
      if (k != none) seeds.push_back(k);
  }
  leaving_[at(b)] = none;
  for (Index v : touched) leaving_[at(v)] = none;
  // Any living half-edge at a touched vertex will do, then wind back to the border if there is one.
  const auto wind = [&](Index v, Index leaving) {
    Index first = leaving;
    for (Index k = leaving; opposite(k) != none;) {
      k = next(opposite(k));
      if (k == leaving) break;
      first = k;
    }
    if (opposite(first) != none) first = leaving;
    leaving_[at(v)] = first;
  };
  for (Index k : seeds) {
    if (!alive(k)) continue;
    if (leaving_[at(from(k))] == none) wind(from(k), k);
    if (leaving_[at(to(k))] == none) wind(to(k), next(k));
  }
}

void HalfEdges::flip(Index h) {
  // (a, b, c) with h = a → b and (b, a, d) with o = b → a become (d, c, a) with h = d → c and (c, d, b) with o = c → d.
  const Index o = opposite(h);
  const Index a = from(h);
  const Index b = to(h);
  const Index c = apex(h);
  const Index d = apex(o);
  const Index bc = opposite(next(h));
  const Index ca = opposite(previous(h));
  const Index ad = opposite(next(o));
  const Index db = opposite(previous(o));
  const Index h1 = next(h);
  const Index h2 = previous(h);
  const Index o1 = next(o);
  const Index o2 = previous(o);
  corner_[at(h)] = d;
  corner_[at(h1)] = c;
  corner_[at(h2)] = a;
  corner_[at(o)] = c;
  corner_[at(o1)] = d;
  corner_[at(o2)] = b;
  glue(h1, ca);
  glue(h2, ad);
  glue(o1, db);
  glue(o2, bc);
  glue(h, o);
  const auto restore = [&](Index v, Index half) {
    const Index old = leaving_[at(v)];
    if (old == h || old == h1 || old == h2 || old == o || old == o1 || old == o2) leaving_[at(v)] = half;
  };
  // A border half-edge that moved within the two triangles is found again.
  restore(a, h2);
  restore(b, o2);
  restore(c, h1);
  restore(d, o1);
}

std::vector<std::array<Index, 3>> HalfEdges::compact(std::vector<Index>& kept) const {
  kept.clear();
  std::vector<Index> number(leaving_.size(), none);
  for (Index v = 0; v < vertices(); ++v)
    if (vertex_alive(v)) {
      number[at(v)] = static_cast<Index>(kept.size());
      kept.push_back(v);
    }
  std::vector<std::array<Index, 3>> triangles;
  for (Index h = 0; h < count(); h += 3)
    if (alive(h)) triangles.push_back({number[at(from(h))], number[at(to(h))], number[at(apex(h))]});
  return triangles;
}

}  // namespace endowire::vessel::anatomy
