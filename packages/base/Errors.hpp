#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace suture {

/// Exit code of a program that stops with the error. Users' scripts rely on these values.
enum class ExitCode : int { Done = 0, CommandLine = 2, Input = 3, Numerical = 4, Environment = 5, Internal = 70, Stopped = 75 };

/// Shortens a message for people: a word or single-quoted text of more than 200 characters is cut and its length noted; so is a line of
/// more than 4000. Every Error passes its message through here. Local.
std::string shortened(const std::string& message);

/// Base of all errors of Suture. The library throws; only drivers print and exit.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(shortened(message)), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// One problem of the input: where (path in the scene file, or the file itself) and the value found against the one expected.
struct Problem {
  std::string path;
  std::string message;
};

/// All problems of a scene, its mesh or its groups, reported together.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(const std::string& path, const std::string& message) : InputError(std::vector<Problem>{{path, message}}) {}
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Wrong command line.
class CommandLineError : public Error {
 public:
  explicit CommandLineError(const std::string& message) : Error(ExitCode::CommandLine, message) {}
};

/// No convergence, a breakdown, or an unexpectedly singular matrix.
class NumericalError : public Error {
 public:
  explicit NumericalError(const std::string& message) : Error(ExitCode::Numerical, message) {}
};

/// A problem of the machine: no memory, an unwritable folder, a library without a feature.
class EnvironmentError : public Error {
 public:
  explicit EnvironmentError(const std::string& message) : Error(ExitCode::Environment, message) {}
};

/// A bug in Suture: a condition that the code itself should guarantee does not hold.
class InternalError : public Error {
 public:
  explicit InternalError(const std::string& message) : Error(ExitCode::Internal, message) {}
};

/// Collects problems so that the user sees all of them together.
class Problems {
 public:
  void add(const std::string& path, const std::string& message) { list_.push_back({path, message}); }
  void add(const InputError& error) { list_.insert(list_.end(), error.problems().begin(), error.problems().end()); }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }
  /// \throws InputError  with all problems, if there are any.
  void throwIfAny() const {
    if (!list_.empty()) throw InputError(list_);
  }

 private:
  std::vector<Problem> list_;
};

/// The candidate nearest to `name` (edit distance, case ignored), or "" if none is close enough.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

/// " Did you mean 'x'? Known here: a, b, c": appended to the message about an unknown name. Candidates are listed sorted.
std::string suggestion(const std::string& name, std::vector<std::string> candidates);

/// "no such <kind> 'name'. Did you mean 'x'? Known here: a, b, c": the sentence for every unknown name.
std::string unknownName(const std::string& kind, const std::string& name, const std::vector<std::string>& candidates);

/// "a, b, c"; long lists are cut after `most` names with "... (N in all)".
std::string joinNames(const std::vector<std::string>& names, std::size_t most = 30);

}  // namespace suture
