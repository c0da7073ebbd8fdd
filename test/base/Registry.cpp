#include <suture/base/Registry.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>

// A kind of strategy in a separate package: its registerBuiltIns is found although Registry knows nothing of the namespace.
namespace zoo {

struct Animal {
  virtual ~Animal() = default;
  virtual std::string says() const = 0;
  static std::string kind() { return "animal"; }
};

struct Dog : Animal {
  explicit Dog(const suture::Parameters& own) : sound(own.get<std::string>("Sound")) {}
  std::string says() const override { return sound; }
  std::string sound;
};

struct Cat : Animal {
  std::string says() const override { return "miaow"; }
};

void registerBuiltIns(suture::Registry<Animal>& registry) {
  registry.add("Dog", suture::Schema("a dog").text("Sound", "woof", "what it says"),
               [](const suture::Parameters& own) { return std::make_unique<Dog>(own); });
}

}  // namespace zoo

namespace {

using namespace suture;
using Animals = Registry<zoo::Animal>;

// Registers as a user's shared library does: while the program is loaded, before any built-in is used.
const Registration<zoo::Animal> cat("Cat", Schema("a cat"), [](const Parameters&) { return std::make_unique<zoo::Cat>(); });

TEUCHOS_UNIT_TEST(Registry, KnowsBuiltInsAndAddedOnes) {
  TEST_ASSERT((Animals::instance().names() == std::vector<std::string>{"Cat", "Dog"}));
  TEST_ASSERT(Animals::instance().has("Dog"));
  TEST_ASSERT(!Animals::instance().has("Cow"));
}

TEUCHOS_UNIT_TEST(Registry, MakesByNameFromTheOwnParameters) {
  Parameters own;
  own.set("Sound", std::string("wau"));
  TEST_EQUALITY(Animals::instance().make("Dog", own)->says(), "wau");
  TEST_EQUALITY(Animals::instance().make("Cat", Parameters())->says(), "miaow");
}

TEUCHOS_UNIT_TEST(Registry, AnUnknownNameListsTheKnownOnes) {
  std::string message;
  try {
    Animals::instance().make("Dgo", Parameters());
  } catch (const InputError& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "animal: no such animal 'Dgo'. Did you mean 'Dog'? Known here: Cat, Dog");
}

TEUCHOS_UNIT_TEST(Registry, RefusesATakenName) {
  TEST_THROW(Animals::instance().add("Dog", Schema(), [](const Parameters&) { return std::make_unique<zoo::Cat>(); }), InternalError);
}

TEUCHOS_UNIT_TEST(Registry, GivesTheSchemasOfAChoice) {
  const auto schemas = Animals::instance().schemas();
  TEST_EQUALITY(schemas.size(), 2u);
  TEST_ASSERT(schemas.at("Dog").find("Sound") != nullptr);
}

}  // namespace
