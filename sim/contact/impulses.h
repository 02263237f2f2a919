// What touching surfaces do to each other's velocities.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/contact/contact_pair.h"
#include "sim/contact/contact_surface.h"

namespace billow::sim {

/// A vertex and a half-space near it.
struct PlaneContact {
  int plane, vertex;
  Eigen::Vector3d normal;    // unit, out of the solid
  Eigen::Vector3d velocity;  // [m/s] of the solid where the vertex is
  double gap;                // [m] beyond the thickness; negative within it
  double friction;
};

/// Inelastic contact with Coulomb friction: in every contact the surfaces may close the gap that is left within a step
/// and no more, and what friction can hold does not slide. Sweeps of Gauss and Seidel over the contacts in their order,
/// forward and backward in turn; an impulse acts on both sides, so momentum is kept to rounding, and each takes kinetic
/// energy out, seen from what it acts against. They start from the impulses of the step before, which in a stack are
/// nearly right; where what comes out has gained energy after all, they start from none.
class Impulses {
 public:
  explicit Impulses(const ContactSurface& surface)
      : surface_(surface), push_(surface.rest.size(), Eigen::Vector3d::Zero()), pushes_on_(surface.rest.size(), 0) {
    forget();
  }

  /// The first call of a step starts from the last step's impulses; further ones add to its own.
  struct Call {
    bool first = true;
    int sweeps = 5;
  };

  /// Impulses are remembered for these pairs from now on; those of the same features are taken over.
  void remember(const std::vector<ContactPair>& pairs);
  /// The next step does not follow from the last one.
  void forget();

  /// Changes v (N) [m/s], the velocities with which the vertices go from `x` (N) [m] for h [s]. `spin` [rad/s] is how
  /// fast each part turns that is rounded.
  void apply(const std::vector<ContactPair>& pairs, const std::vector<PlaneContact>& planes, const Points& spin,
             const Points& x, double h, const Call& call, Points& v);

  /// [m] (N) by which vertices within the thickness are to be pushed out of it besides moving, as of the last call.
  const Points& push() const { return push_; }
  bool pushes() const { return !pushing_.empty(); }
  /// [J] that the last call put in by what no contact moves: colliders and pins in motion.
  double work() const { return work_; }

 private:
  /// A contact that may have to act in this step. Sweeps read all of them again and again: it holds what they need.
  struct Active {
    std::array<int, 4> vertex;  // of a contact with a half-space the same one, with no weight but once
    std::array<double, 4> weight;
    Eigen::Vector3d normal;
    double least;  // [m/s] of the sides' relative velocity along the normal
    double mass;   // [kg] effective
    double friction;
    double normal_impulse = 0.0;                                 // [N s] so far
    Eigen::Vector3d friction_impulse = Eigen::Vector3d::Zero();  // [N s]
    int memory;                                                  // its place there
    int solid = -1;                                              // its place in solid_velocity_; -1: none
  };
  /// One whose sides are within their thickness.
  struct Pushing {
    int contact;
    double way;  // [m] apart
  };
  Eigen::Vector3d turning(const ContactPair& pair, const Points& spin) const;
  void gather(const std::vector<ContactPair>& pairs, const std::vector<PlaneContact>& planes, const Points& spin,
              const Points& x, double h, const Points& v);
  void add(Active contact, const Eigen::Vector3d* solid_velocity, double gap, double h);
  void find_push();
  void forget_push();
  void start_from_memory(Points& v);
  void solve_all(int sweeps, Points& v);
  void note(bool first);
  Eigen::Vector3d relative_velocity(const Active& contact, const Points& v) const;
  double energy_given(const Points& v) const;
  void act(const Active& contact, const Eigen::Vector3d& impulse, Points& v) const;
  double solve(Active& contact, Points& v) const;
  double work_of(const Active& contact, const Points& v) const;

  const ContactSurface& surface_;
  /// What a contact did in the last step, and of that in the one before too: a blow does not come twice.
  struct Memory {
    double normal = 0.0, lasting = 0.0;                  // [N s]
    Eigen::Vector3d friction = Eigen::Vector3d::Zero();  // [N s]
  };
  /// on_a and the corners: a vertex and a triangle may have the same as two edges.
  using Key = std::array<int, 5>;
  static Key key_of(const ContactPair& pair);
  std::vector<Key> known_;      // the pairs that are remembered
  std::vector<Memory> memory_;  // theirs, and then by half-space and vertex
  std::vector<double> last_;    // [N s] normal impulses of the step before, where memory_ has this one's
  Points at_first_;             // velocities that a solution starts from
  std::vector<Active> active_;
  std::vector<int> driven_;  // of the active, those that something touches which no contact moves
  Points solid_velocity_;    // [m/s] of half-spaces, and of what turns about its one point or segment
  Points before_;            // [m/s] the active's sides' relative velocity before any impulse
  Points push_;
  std::vector<Pushing> pushing_;
  std::vector<int> pushes_on_;  // (N)
  double work_ = 0.0;
};

}  // namespace billow::sim
