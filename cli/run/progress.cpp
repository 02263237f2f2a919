// Progress lines.
#include "cli/run/progress.h"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace billow::cli {

namespace {

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string time_left(double left) {
  const long whole = static_cast<long>(left + 0.5);
  return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(ProgressStyle style) : style_(style) {
  redraw_ = style == ProgressStyle::automatic && isatty(STDERR_FILENO);
}

void Progress::begin(std::string_view stage, long total) {
  stage_ = stage;
  total_ = total;
  begin_ = last_ = Clock::now();
}

void Progress::update(long done, double time) {
  if (style_ == ProgressStyle::none) return;
  const Clock::time_point now = Clock::now();
  const double pause = redraw_ ? 0.1 : 2.0;
  if (done < total_ && seconds(now - last_) < pause) return;
  last_ = now;
  print_line(done, time);
}

void Progress::print_line(long done, double time) {
  const double elapsed = seconds(last_ - begin_), rate = elapsed > 0.0 ? static_cast<double>(done) / elapsed : 0.0;
  const double left = rate > 0.0 ? static_cast<double>(total_ - done) / rate : 0.0;
  std::string line;
  if (style_ == ProgressStyle::json)
    line = nlohmann::json{{"stage", stage_}, {"done", done}, {"total", total_},
                          {"time", time},    {"rate", rate}, {"seconds_left", left}}
               .dump() +
           "\n";
  else
    line = fmt::format("{}{}: frame {} of {}, t = {:.2f} s, {:.1f} frames/s, {} left{}", redraw_ ? "\r\033[K" : "",
                       stage_, done, total_, time, rate, time_left(left), redraw_ ? "" : "\n");
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void Progress::say(const std::string& line) const {
  const std::string text = style_ == ProgressStyle::json ? nlohmann::json{{"message", line}}.dump() : line;
  std::fputs((text + "\n").c_str(), stderr);
  std::fflush(stderr);
}

void Progress::end() {
  if (redraw_) std::fputs("\r\033[K", stderr);
}

}  // namespace billow::cli
