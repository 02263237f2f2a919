// Progress lines.
#include "cli/run/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/announcement.h"
#include "cli/text/json_text.h"

namespace billow::cli {

namespace {

constexpr double long_phase = 0.5;  // [s] a phase that lasts longer is said

double seconds_of(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string time_left(double left) {
  const long whole = std::lround(left);
  return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

Words<ProgressStyle> words(ProgressStyle) {
  static constexpr Word<ProgressStyle> list[] = {{"auto", ProgressStyle::automatic},
                                                 {"plain", ProgressStyle::plain},
                                                 {"json", ProgressStyle::json},
                                                 {"none", ProgressStyle::none}};
  return list;
}

Remarks remarks_of(ProgressStyle style) {
  switch (style) {
    case ProgressStyle::automatic:
    case ProgressStyle::plain:
      return Remarks::lines;
    case ProgressStyle::json:
      return Remarks::json;
    case ProgressStyle::none:
      return Remarks::none;
  }
  throw std::logic_error("a style of progress has no remarks");
}

void say_ended(const EndedPiece& piece) {
  if (remarks() == Remarks::json)
    return say_json(json_text(nlohmann::ordered_json{{"stage", piece.stage},
                                                     {"done", piece.done},
                                                     {"total", piece.total},
                                                     {"name", piece.name},
                                                     {"status", piece.status},
                                                     {"how", piece.how}}));
  say_line("[{}/{}] {}: {} {}", piece.done, piece.total, piece.name, piece.status, piece.how);
}

Progress::Progress(ProgressStyle style, Clock::time_point begin)
    : style_(style),
      redraw_(style == ProgressStyle::automatic && isatty(STDERR_FILENO)),
      start_(begin),
      phase_begin_(begin) {}

void Progress::phase(std::string_view name, std::string_view subject) {
  end();
  past_ = phases();
  phase_begin_ = Clock::now();
  const auto known = std::find_if(past_.begin(), past_.end(), [&](const PhaseTime& p) { return p.name == name; });
  present_ = static_cast<std::size_t>(known - past_.begin());
  if (known == past_.end()) past_.push_back({std::string(name)});
  if (style_ != ProgressStyle::none) announce_later(announcement(name, subject), long_phase);
}

std::string Progress::announcement(std::string_view name, std::string_view subject) const {
  if (style_ == ProgressStyle::json)
    return printable_json(json_text(nlohmann::json{{"phase", name}, {"subject", subject}})) + "\n";
  const std::string line = fmt::format("{}{}{} ...", name, subject.empty() ? "" : " ", printable(subject));
  return redraw_ ? fmt::format("{}{}", wipe, line) : line + "\n";
}

double Progress::seconds(std::string_view phase) const {
  for (const PhaseTime& time : phases())
    if (time.name == phase) return time.seconds;
  return 0.0;
}

std::vector<PhaseTime> Progress::phases() const {
  std::vector<PhaseTime> all = past_;
  all[present_].seconds += seconds_of(Clock::now() - phase_begin_);
  return all;
}

double Progress::wall() const { return seconds_of(Clock::now() - start_); }

void Progress::begin(std::string_view stage, long total) {
  end();
  stage_ = stage;
  total_ = total;
  begin_ = last_ = Clock::now();
}

void Progress::update(long done, double time) {
  if (style_ == ProgressStyle::none) return;
  const Clock::time_point now = Clock::now();
  const double pause = redraw_ ? 0.1 : 2.0;
  if (done < total_ && seconds_of(now - last_) < pause) return;
  last_ = now;
  print_line(done, time);
}

void Progress::print_line(long done, double time) {
  const double elapsed = seconds_of(last_ - begin_), rate = elapsed > 0.0 ? static_cast<double>(done) / elapsed : 0.0;
  const double left = rate > 0.0 ? static_cast<double>(total_ - done) / rate : 0.0;
  if (style_ == ProgressStyle::json)
    return say_json(json_text(nlohmann::json{
        {"stage", stage_}, {"done", done}, {"total", total_}, {"time", time}, {"rate", rate}, {"seconds_left", left}}));
  const std::string line = fmt::format("{}: frame {} of {}, t = {:.2f} s, {:.1f} frames/s, {} left", stage_, done,
                                       total_, time, rate, time_left(left));
  redraw_ ? redraw_line(line) : say_message(line);
}

void Progress::say(const std::string& line) {
  if (style_ == ProgressStyle::none) return;
  end();
  style_ == ProgressStyle::json ? say_json(json_text(nlohmann::json{{"message", line}})) : say_message(line);
}

void Progress::end() {
  withdraw_announcement();
  if (redraw_) wipe_line();
}

}  // namespace billow::cli
