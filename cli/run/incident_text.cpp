// Words for incidents.
#include "cli/run/incident_text.h"

#include <fmt/format.h>

#include <cmath>

namespace billow::cli {

std::string_view name(sim::Incident::Kind kind) {
  switch (kind) {
    case sim::Incident::Kind::energy:
      return "energy";
    case sim::Incident::Kind::divergence:
      return "divergence";
    case sim::Incident::Kind::unexplained:
      return "unexplained";
  }
  return "";
}

std::string incident_text(const sim::Incident& incident, double step) {
  const std::string what = incident.kind == sim::Incident::Kind::divergence
                               ? "the motion ran away"
                               : "the energy climbed beyond the work put in";
  if (incident.kind == sim::Incident::Kind::unexplained)
    return fmt::format("{} by t = {:.4g} s, and smaller steps did not change that", what, incident.seen);
  if (incident.halvings == 0)
    return fmt::format("{} by t = {:.4g} s; the step was given, so it stays: 'watch: true' lets it change", what,
                       incident.seen);
  const std::string until = incident.end > 0.0 ? fmt::format(" to {:.4g}", incident.end) : "";
  return fmt::format("{} by t = {:.4g} s; from {:.4g}{} s steps were as small as {:.3g} s, and {} were thrown away",
                     what, incident.seen, incident.begin, until, std::ldexp(step, -incident.halvings),
                     incident.discarded);
}

}  // namespace billow::cli
