// Joining and splitting lines.
#include "sim/import/text_lines.h"

#include <algorithm>

#include "sim/import/mesh_text.h"

namespace billow::sim {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text;
}

}  // namespace

bool TextLines::next_joined() {
  if (at_ >= text_.size()) return false;
  joined_.clear();
  bool continues = true;
  for (bool first = true; continues && at_ < text_.size(); first = false) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    content_ = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_.number;
    continues = content_.ends_with('\\');
    if (first && !continues) break;
    joined_ += content_.substr(0, content_.size() - (continues ? 1 : 0));
    joined_ += ' ';
    content_ = joined_;
  }
  content_ = trimmed(content_.substr(0, content_.find('#')));
  return true;
}

void TextLines::split() {
  line_.words.clear();
  for (std::size_t at = 0; at < content_.size();) {
    std::size_t end = at;
    while (end < content_.size() && !is_blank(content_[end])) ++end;
    line_.words.push_back(content_.substr(at, end - at));
    while (end < content_.size() && is_blank(content_[end])) ++end;
    at = end;
    if (line_.words.size() == 1) line_.rest = content_.substr(at);
  }
}

bool TextLines::next() {
  while (next_joined()) {
    if (content_.empty()) continue;
    split();
    return true;
  }
  return false;
}

}  // namespace billow::sim
