#include "StoppableOutput.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iostream>

#include "Program.hpp"
#include "StopSignals.hpp"

namespace suture {

namespace {

constexpr std::size_t most = 4096;  // characters collected without a flush
constexpr std::size_t piece = 256;  // characters that a ready terminal or pipe takes without blocking
constexpr int pause = 100;          // milliseconds for the reader after a stop signal

}  // namespace

StoppableOutput::StoppableOutput() : before_(std::cout.rdbuf(this)), terminal_(suture::isTerminal()) {}

StoppableOutput::~StoppableOutput() {
  wipe();
  sync();
  std::cout.rdbuf(before_);
}

StoppableOutput::int_type StoppableOutput::overflow(int_type letter) {
  if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
  const char one = traits_type::to_char_type(letter);
  return xsputn(&one, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize StoppableOutput::xsputn(const char* text, std::streamsize length) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (text_.empty()) wipe();
  text_.append(text, static_cast<std::size_t>(length));
  return text_.size() < most || send() == 0 ? length : 0;
}

int StoppableOutput::sync() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return send();
}

int StoppableOutput::failure() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

void StoppableOutput::wipe() {
  if (!isWiped_) text_.insert(0, "\r\033[K");
  isWiped_ = true;
}

void StoppableOutput::between(const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (text_.empty() ? !endsLine_ : text_.back() != '\n') return;
  if (!terminal_) {
    send();
    const std::string whole = line + "\n";
    if (takesText(STDERR_FILENO, 0) && write(STDERR_FILENO, whole.data(), whole.size()) < 0) return;
    return;
  }
  wipe();
  text_ += line;
  isWiped_ = false;
  send();
  endsLine_ = true;
}

int StoppableOutput::send() {
  if (!text_.empty()) endsLine_ = text_.back() == '\n';
  std::string text;
  text.swap(text_);
  for (std::size_t sent = 0; sent < text.size();) {
    const bool stop = stopWasAsked();  // before the wait: the reader gets the whole pause even if a signal interrupts the wait
    if (!takesText(STDOUT_FILENO, pause)) {
      if (stop) break;
      continue;
    }
    const ssize_t count = write(STDOUT_FILENO, text.data() + sent, std::min(piece, text.size() - sent));
    if (count < 0 && errno != EINTR && errno != EAGAIN) {
      if (failure_ == 0) failure_ = errno;
      return -1;
    }
    sent += static_cast<std::size_t>(std::max<ssize_t>(0, count));
  }
  return 0;
}

}  // namespace suture
