#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cavea {

/// Space of the C locale. Not NUL: that is junk in a text.
constexpr bool is_space(char c) { return c == ' ' || static_cast<unsigned char>(c - '\t') < 5; }

/// Overwrites comments, from # to the end of the line, with spaces, and returns the words: tokens
/// that begin with a letter and are no spelling of a number (nan, inf), as views into the text.
std::vector<std::string_view> scan_words(std::span<char> text);

/// Number of tokens in a text that begins and ends between tokens.
std::size_t count_tokens(std::string_view text);

/// Cuts a text into pieces of about `size` bytes, between tokens; returns the offsets of their
/// beginnings and the length of the text.
std::vector<std::size_t> cut_between_tokens(std::string_view text, std::size_t size);

/// One-based number of the line that holds the byte at an offset.
std::size_t line_of(std::string_view text, std::size_t offset);

/// The token that begins at the offset, for a message: cut where it is long, ? for what is no ASCII
/// character that can be seen.
std::string_view token_at(std::string_view text, std::size_t offset);
std::string printable(std::string_view token);

}  // namespace cavea
