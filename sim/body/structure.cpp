// Words of the structure's enumerations, and several structures as one.
#include "sim/body/structure.h"

namespace billow::sim {

Words<SpringKind> words(SpringKind) {
  static constexpr Word<SpringKind> list[] = {
      {"structural", SpringKind::structural}, {"shear", SpringKind::shear},   {"bend", SpringKind::bend},
      {"cross", SpringKind::cross},           {"normal", SpringKind::normal}, {"muscle", SpringKind::muscle},
      {"interior", SpringKind::interior}};
  return list;
}

Words<SpringModel> words(SpringModel) {
  static constexpr Word<SpringModel> list[] = {{"springs", SpringModel::linear}, {"choi_ko", SpringModel::choi_ko}};
  return list;
}

Words<DampingModel> words(DampingModel) {
  static constexpr Word<DampingModel> list[] = {{"projected", DampingModel::projected},
                                                {"spring", DampingModel::spring}};
  return list;
}

namespace {

Body shifted(Body body, int particles, int springs) {
  body.first_particle += particles;
  body.first_spring += springs;
  return body;
}

void append(Structure& whole, const Structure& part, int particles, int springs) {
  whole.rest_position.middleRows(particles, part.particles()) = part.rest_position;
  whole.mass.segment(particles, part.particles()) = part.mass;
  whole.inverse_mass.segment(particles, part.particles()) = part.inverse_mass;
  whole.spring.middleRows(springs, part.springs()) = part.spring.array() + particles;
  whole.rest_length.segment(springs, part.springs()) = part.rest_length;
  whole.stiffness.segment(springs, part.springs()) = part.stiffness;
  whole.damping.segment(springs, part.springs()) = part.damping;
  whole.kind.insert(whole.kind.end(), part.kind.begin(), part.kind.end());
  for (const Body& body : part.body) whole.body.push_back(shifted(body, particles, springs));
}

}  // namespace

Eigen::VectorXd free_mass(const Structure& structure) {
  return structure.inverse_mass.cwiseSign().cwiseProduct(structure.mass);
}

Eigen::VectorXd free_mass(const Structure& structure, const Body& body) {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(structure.particles());
  mass.segment(body.first_particle, body.particles) = free_mass(structure).segment(body.first_particle, body.particles);
  return mass;
}

bool is_damped(const Structure& structure, const Body& body) {
  return (structure.damping.segment(body.first_spring, body.springs).array() > 0.0).any();
}

const Body& body_of(const Structure& structure, int particle) {
  for (const Body& body : structure.body)
    if (particle < body.first_particle + body.particles) return body;
  return structure.body.back();
}

Structure merge(const std::vector<Structure>& parts) {
  int particles = 0, springs = 0;
  for (const Structure& part : parts) particles += part.particles(), springs += part.springs();
  Structure whole;
  whole.rest_position.resize(particles, 3);
  whole.mass.resize(particles);
  whole.inverse_mass.resize(particles);
  whole.spring.resize(springs, 2);
  whole.rest_length.resize(springs);
  whole.stiffness.resize(springs);
  whole.damping.resize(springs);
  particles = springs = 0;
  for (const Structure& part : parts) {
    append(whole, part, particles, springs);
    particles += part.particles(), springs += part.springs();
  }
  return whole;
}

}  // namespace billow::sim
