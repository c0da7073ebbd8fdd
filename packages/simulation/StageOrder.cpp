#include <suture/base/Errors.hpp>
#include <suture/simulation/StageOrder.hpp>

namespace suture {

namespace {

/// Name of the function that runs a stage.
std::string functionOf(StageOrder::Stage stage) {
  switch (stage) {
    case StageOrder::Nothing:
      return "the constructor";
    case StageOrder::Read:
      return "read()";
    case StageOrder::Cut:
      return "cut()";
    case StageOrder::Checked:
      return "check()";
    case StageOrder::Prepared:
      return "prepare()";
    case StageOrder::Solved:
      return "iterate()";
    case StageOrder::Judged:
      return "judge()";
  }
  return "";
}

}  // namespace

void StageOrder::require(Stage least, Stage most, const std::string& function) const {
  const std::string order = "; expected order: read(), cut(), check(), prepare(), iterate(), judge(), each once";
  if (!failed_.empty()) throw InternalError(function + "() after " + failed_ + "(), which failed: create a new Simulation");
  if (done_ < least) throw InternalError(function + "() before " + functionOf(least) + order);
  if (done_ > most) throw InternalError(function + "() after " + functionOf(done_) + order);
}

void StageOrder::make(Stage before, Stage after, const std::string& function, const std::function<void()>& work) {
  require(before, before, function);
  failed_ = function;
  work();
  failed_.clear();
  done_ = after;
}

}  // namespace suture
