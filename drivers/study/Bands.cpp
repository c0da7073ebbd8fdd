#include "Bands.hpp"

#include <algorithm>
#include <suture/report/Format.hpp>

namespace suture::study {
namespace {

std::string number(double value) { return format("%.4g", value); }

// Checks the limits of a band and collects the words of its sentence.
class Judge {
 public:
  Judge(const Band& band, double least, double most) {
    if (band.atMost) add(most <= *band.atMost, "at most " + number(*band.atMost));
    if (band.atLeast) add(least >= *band.atLeast, "at least " + number(*band.atLeast));
    if (band.ratioAtMost) {
      const bool meaningful = least > 0.0;
      add(meaningful && most <= *band.ratioAtMost * least,
          "largest over smallest " + (meaningful ? number(most / least) : "(not all above 0)") + ", at most " + number(*band.ratioAtMost));
    }
    if (band.differenceAtMost)
      add(most - least <= *band.differenceAtMost,
          "largest minus smallest " + number(most - least) + ", at most " + number(*band.differenceAtMost));
  }
  bool kept() const { return kept_; }
  const std::string& words() const { return words_; }

 private:
  void add(bool kept, const std::string& words) {
    kept_ = kept_ && kept;
    words_ += (words_.empty() ? "" : "; ") + words;
  }
  bool kept_ = true;
  std::string words_;
};

}  // namespace

std::vector<Verdict> judgeBands(const Study& study, const std::vector<Row>& rows) {
  std::vector<Verdict> verdicts;
  for (std::size_t b = 0; b < study.bands.size(); ++b) {
    const Band& band = study.bands[b];
    std::vector<double> values;
    int missing = 0;
    for (const Row& row : rows) {
      if (!passes(band.where, study.sweeps, row.run->choice)) continue;
      if (row.judged[b].isNumber())
        values.push_back(row.judged[b].number);
      else
        ++missing;
    }
    Verdict verdict{band.name, false, !values.empty() || missing > 0, band.column + ": "};
    if (values.empty()) {
      verdict.sentence += missing > 0 ? "no run that counts has a value" : "no run that counts was run";
    } else {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      const Judge judge(band, *least, *most);
      verdict.kept = judge.kept() && missing == 0;
      verdict.sentence += (*least == *most ? number(*most) : number(*least) + " to " + number(*most)) + " over " +
                          counted(static_cast<long long>(values.size()), "run") + ", " + judge.words();
      if (missing > 0) verdict.sentence += "; " + counted(missing, "run") + " without a value";
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

std::string bandsMarkdown(const std::vector<Verdict>& verdicts) {
  std::string text = "| band | | |\n|---|---|---|\n";
  for (const Verdict& verdict : verdicts)
    text += "| " + verdict.band + " | " + verdict.sentence + " | " +
            (!verdict.judged ? "not run"
             : verdict.kept  ? "kept"
                             : "MISSED") +
            " |\n";
  return text;
}

}  // namespace suture::study
