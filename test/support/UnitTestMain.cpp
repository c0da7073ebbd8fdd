// The one main of all unit tests: a test passes only if it passes on every rank.
//   --group=A,B   runs the tests of the groups A and B
// A call fails if it runs no test, or none of one of the groups: a wrong name must not pass.
#include <Teuchos_FancyOStream.hpp>
#include <Teuchos_UnitTestRepository.hpp>
#include <Teuchos_VerboseObject.hpp>
#include <Tpetra_Core.hpp>
#include <iostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <vector>

namespace {

/// Buffer that writes to the console and keeps the text. Teuchos prints the number of tests only there, on rank 0.
class KeptText : public std::streambuf {
 public:
  std::string text;

 protected:
  int overflow(int c) override {
    if (c == traits_type::eof()) return traits_type::not_eof(c);
    text += char(c);
    return std::cout.rdbuf()->sputc(char(c));
  }
  int sync() override { return std::cout.rdbuf()->pubsync(); }
};

/// Runs the tests that the arguments select. \return the exit code
int run(std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  KeptText kept;
  std::ostream stream(&kept);
  Teuchos::VerboseObjectBase::setDefaultOStream(Teuchos::fancyOStream(Teuchos::rcpFromRef(stream)));
  const int code = Teuchos::UnitTestRepository::runUnitTestsFromMain(int(argv.size()), argv.data());
  Teuchos::VerboseObjectBase::setDefaultOStream(Teuchos::fancyOStream(Teuchos::rcpFromRef(std::cout)));
  if (code != 0 || kept.text.find(", run = 0,") == std::string::npos) return code;
  std::cout << "No test of this program has these names:";
  for (auto& argument : arguments) std::cout << ' ' << argument;
  std::cout << '\n';
  return 1;
}

}  // namespace

int main(int argc, char* argv[]) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  Teuchos::UnitTestRepository::setGloballyReduceTestResult(true);
  const std::string option = "--group=";
  std::vector<std::string> arguments, groups;
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind(option, 0) != 0) {
      arguments.push_back(argument);
      continue;
    }
    std::istringstream names(argument.substr(option.size()));
    for (std::string name; std::getline(names, name, ',');) groups.push_back(name);
  }
  if (groups.empty()) return run(arguments);
  int code = 0;
  for (const auto& group : groups) {
    auto chosen = arguments;
    chosen.push_back(option + group);
    code = std::max(code, run(chosen));
  }
  return code;
}
