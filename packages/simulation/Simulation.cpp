#include <suture/simulation/Simulation.hpp>

namespace suture {

const Solution& Simulation::solve(const std::string& restart) {
  if (!judged_) {
    PreparedScene prepared = prepare(check(cut(read(run_, scene_))));
    prepared.remark();
    prepared.startFrom(restart);
    judged_ = refine(judge(suture::solve(std::move(prepared))));
  }
  return judged_->solution();
}

const JudgedScene& Simulation::judged(const std::string& function) const {
  if (!judged_) throw InternalError(function + "() before solve()");
  return *judged_;
}

}  // namespace suture
