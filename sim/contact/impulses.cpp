// Gauss-Seidel over contacts.
#include "sim/contact/impulses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace billow::sim {

namespace {

// [m/s] by which the last sweep may still have changed a relative velocity.
constexpr double settled = 1e-4;
// Of what a vertex is within the thickness: pushed out a step (Bridson, Fedkiw & Anderson 2002), and the most [m/s].
constexpr double push_share = 0.1, fastest_push = 0.1;
// Where all that could give way is hardly part of a contact, as next to pins, it is not thrown aside for it: its share
// of the contact's inverse mass counts as at least so much.
constexpr double least_part = 0.01;
// Of the thickness: contacts that would keep so much of it are not expected to act.
constexpr double distant = 0.1;

}  // namespace

namespace {

struct HashOfKey {
  std::size_t operator()(const std::array<int, 5>& key) const {
    std::uint64_t hash = 0;
    for (const int v : key) hash = (hash ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u, hash ^= hash >> 29;
    return hash;
  }
};

}  // namespace

Impulses::Key Impulses::key_of(const ContactPair& pair) {
  const auto& [a, b, c, d] = pair.vertex;
  return {pair.on_a, a, b, c, d};
}

void Impulses::remember(const std::vector<ContactPair>& pairs) {
  std::unordered_map<Key, Memory, HashOfKey> before;
  for (std::size_t k = 0; k < known_.size(); ++k)
    if (memory_[k].normal > 0.0) before.emplace(known_[k], memory_[k]);
  const std::vector<Memory> planes(memory_.begin() + static_cast<std::ptrdiff_t>(known_.size()), memory_.end());
  known_.clear(), memory_.clear();
  for (const ContactPair& pair : pairs) {
    known_.push_back(key_of(pair));
    const auto found = pair.acts ? before.find(known_.back()) : before.end();
    memory_.push_back(found == before.end() ? Memory{} : found->second);
  }
  memory_.insert(memory_.end(), planes.begin(), planes.end());
}

void Impulses::forget() {
  known_.clear();
  memory_.assign(surface_.half_space.size() * surface_.rest.size(), {});
}

void Impulses::start_from_memory(Points& v) {
  for (Active& contact : active_) {
    const Memory& memory = memory_[contact.memory];
    if (memory.lasting == 0.0) continue;
    contact.normal_impulse = memory.lasting;
    contact.friction_impulse = memory.lasting / memory.normal * memory.friction;
    act(contact, contact.normal_impulse * contact.normal + contact.friction_impulse, v);
  }
}

void Impulses::solve_all(int sweeps, Points& v) {
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double change = 0.0;
    if (sweep % 2 == 0)
      for (Active& contact : active_) change = std::max(change, solve(contact, v));
    else
      for (auto contact = active_.rbegin(); contact != active_.rend(); ++contact)
        change = std::max(change, solve(*contact, v));
    if (change < settled) break;
  }
}

// Of several calls in one step the memory holds the sum.
void Impulses::note(bool first) {
  if (first) {
    last_.resize(memory_.size());
    for (std::size_t k = 0; k < memory_.size(); ++k) last_[k] = memory_[k].normal;
    std::fill(memory_.begin(), memory_.end(), Memory{});
  }
  for (const Active& contact : active_) {
    Memory& memory = memory_[contact.memory];
    memory.normal += contact.normal_impulse;
    memory.friction += contact.friction_impulse;
    memory.lasting = std::min(memory.normal, first ? last_[contact.memory] : memory.lasting);
  }
}

Eigen::Vector3d Impulses::relative_velocity(const Active& contact, const Points& v) const {
  const auto& [a, b, c, d] = contact.vertex;
  const auto& w = contact.weight;
  Eigen::Vector3d relative = w[0] * v[a] + w[1] * v[b] + w[2] * v[c] + w[3] * v[d];
  if (contact.solid >= 0) relative -= solid_velocity_[contact.solid];
  return relative;
}

// [J] kinetic, what moving solids put in left out: every impulse times the mean of the relative velocities before and
// after all of them.
double Impulses::energy_given(const Points& v) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const Active& contact = active_[k];
    if (contact.normal_impulse == 0.0) continue;
    sum += 0.5 * (before_[k] + relative_velocity(contact, v))
                     .dot(contact.normal_impulse * contact.normal + contact.friction_impulse);
  }
  return sum;
}

void Impulses::act(const Active& contact, const Eigen::Vector3d& impulse, Points& v) const {
  for (int k = 0; k < 4; ++k) {
    const int i = contact.vertex[k];
    v[i] += contact.weight[k] * surface_.inverse_mass[i] * impulse;
  }
}

void Impulses::add(Active contact, const Eigen::Vector3d* solid_velocity, double gap, double h) {
  double sum = 0.0, lightest = 0.0;
  bool driven = solid_velocity != nullptr;
  for (int k = 0; k < 4; ++k) {
    const double inverse_mass = surface_.inverse_mass[contact.vertex[k]];
    sum += contact.weight[k] * contact.weight[k] * inverse_mass;
    lightest = std::max(lightest, inverse_mass);
    driven = driven || inverse_mass == 0.0;
  }
  if (sum == 0.0) return;
  contact.mass = 1.0 / std::max(sum, least_part * lightest);
  contact.least = gap > 0.0 ? -gap / h : 0.0;
  const int number = static_cast<int>(active_.size());
  if (driven) driven_.push_back(number);
  if (solid_velocity) {
    contact.solid = static_cast<int>(solid_velocity_.size());
    solid_velocity_.push_back(*solid_velocity);
  }
  active_.push_back(contact);
  if (gap >= 0.0) return;
  pushing_.push_back({number, std::min(push_share * -gap, fastest_push * h)});
  for (int k = 0; k < 4; ++k)
    if (contact.weight[k] != 0.0) ++pushes_on_[contact.vertex[k]];
}

// Both sides by shares that leave their common centre where it is. A vertex in several contacts is asked by each for
// its part only: their sum would throw.
void Impulses::find_push() {
  for (const Pushing& pushing : pushing_) {
    const Active& contact = active_[pushing.contact];
    int most = 1;
    for (const int i : contact.vertex) most = std::max(most, pushes_on_[i]);
    const double impulse = contact.mass * pushing.way / most;
    act(contact, impulse * contact.normal, push_);
  }
}

void Impulses::forget_push() {
  for (const Pushing& pushing : pushing_) {
    const Active& contact = active_[pushing.contact];
    for (const int i : contact.vertex) push_[i].setZero(), pushes_on_[i] = 0;
  }
  pushing_.clear();
}

// The velocity of side b less that of side a which comes from the turning of something rounded: omega x r.
Eigen::Vector3d Impulses::turning(const ContactPair& pair, const Points& spin) const {
  const int a = surface_.part_of[pair.vertex[0]], b = surface_.part_of[pair.vertex[pair.on_a]];
  return (surface_.part[b].radius * spin[b] + surface_.part[a].radius * spin[a]).cross(pair.normal);
}

void Impulses::gather(const std::vector<ContactPair>& pairs, const std::vector<PlaneContact>& planes,
                      const Points& spin, const Points& x, double h, const Points& v) {
  forget_push();
  active_.clear(), driven_.clear(), solid_velocity_.clear();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const ContactPair& pair = pairs[p];
    if (!pair.acts) continue;
    const auto& [a, b, c, d] = pair.vertex;
    const auto& w = pair.weight;
    const Eigen::Vector3d difference = w[0] * x[a] + w[1] * x[b] + w[2] * x[c] + w[3] * x[d];
    const Eigen::Vector3d speed = w[0] * v[a] + w[1] * v[b] + w[2] * v[c] + w[3] * v[d];
    const double gap = pair.normal.dot(difference) - pair.radius - pair.thickness;
    if (gap + h * pair.normal.dot(speed) > distant * pair.thickness) continue;
    const Eigen::Vector3d turn = pair.radius > 0.0 ? turning(pair, spin) : Eigen::Vector3d::Zero();
    add({.vertex = pair.vertex,
         .weight = pair.weight,
         .normal = pair.normal,
         .least = 0.0,
         .mass = 0.0,
         .friction = pair.friction,
         .memory = static_cast<int>(p)},
        pair.radius > 0.0 ? &turn : nullptr, gap, h);
  }
  for (const PlaneContact& plane : planes) {
    if (plane.gap + h * plane.normal.dot(v[plane.vertex] - plane.velocity) > 0.0 && plane.gap > 0.0) continue;
    const int i = plane.vertex;
    add({.vertex = {i, i, i, i},
         .weight = {1.0, 0.0, 0.0, 0.0},
         .normal = plane.normal,
         .least = 0.0,
         .mass = 0.0,
         .friction = plane.friction,
         .memory = static_cast<int>(known_.size() + plane.plane * surface_.rest.size()) + i},
        &plane.velocity, plane.gap, h);
  }
}

// What it changed of the relative velocity [m/s]. The impulse so far may be taken back, never below none; friction is
// bounded by it.
double Impulses::solve(Active& contact, Points& v) const {
  const Eigen::Vector3d relative = relative_velocity(contact, v);
  const double along = contact.normal.dot(relative);
  const double pressed = std::max(0.0, contact.normal_impulse + contact.mass * (contact.least - along));
  if (pressed == 0.0 && contact.normal_impulse == 0.0) return 0.0;
  Eigen::Vector3d impulse = (pressed - contact.normal_impulse) * contact.normal;
  contact.normal_impulse = pressed;
  if (contact.friction > 0.0) {
    Eigen::Vector3d held = contact.friction_impulse - contact.mass * (relative - along * contact.normal);
    const double most = contact.friction * pressed, asked = held.norm();
    if (asked > most) held *= most / asked;
    impulse += held - contact.friction_impulse;
    contact.friction_impulse = held;
  }
  act(contact, impulse, v);
  return impulse.norm() / contact.mass;
}

double Impulses::work_of(const Active& contact, const Points& v) const {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  if (contact.solid >= 0) velocity = solid_velocity_[contact.solid];
  for (int k = 0; k < 4; ++k)
    if (surface_.inverse_mass[contact.vertex[k]] == 0.0) velocity -= contact.weight[k] * v[contact.vertex[k]];
  return velocity.dot(contact.normal_impulse * contact.normal + contact.friction_impulse);
}

void Impulses::apply(const std::vector<ContactPair>& pairs, const std::vector<PlaneContact>& planes, const Points& spin,
                     const Points& x, double h, const Call& call, Points& v) {
  gather(pairs, planes, spin, x, h, v);
  find_push();
  if (call.first) {
    before_.clear();
    for (const Active& contact : active_) before_.push_back(relative_velocity(contact, v));
    at_first_ = v;
    start_from_memory(v);
  }
  solve_all(call.sweeps, v);
  if (call.first && energy_given(v) > 0.0) {
    v = at_first_;
    for (Active& contact : active_) contact.normal_impulse = 0.0, contact.friction_impulse.setZero();
    solve_all(call.sweeps, v);
  }
  work_ = 0.0;
  for (const int k : driven_) work_ += work_of(active_[k], v);
  note(call.first);
}

}  // namespace billow::sim
