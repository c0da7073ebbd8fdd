#include <suture/base/Buffer.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <limits>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Buffer, ReturnsItsContentInOrder) {
  Packer packer;
  packer.put(42);
  packer.put(std::string("with \0 inside", 13));
  packer.put(std::vector<double>{1.5, -2.0, std::numeric_limits<double>::denorm_min()});
  packer.put(std::vector<std::string>{"", "b"});
  packer.put(std::map<std::string, std::vector<int>>{{"left", {1, 2}}, {"right", {}}});
  packer.put(std::vector<double>{});
  packer.put(true);

  Unpacker unpacker(packer.bytes());
  // Read into variables first: TEST_EQUALITY evaluates its arguments more than once.
  const int number = unpacker.get<int>();
  const auto text = unpacker.get<std::string>();
  const auto reals = unpacker.get<std::vector<double>>();
  const auto texts = unpacker.get<std::vector<std::string>>();
  const auto table = unpacker.get<std::map<std::string, std::vector<int>>>();
  const auto none = unpacker.get<std::vector<double>>();
  const bool doneTooEarly = unpacker.done();
  const bool truth = unpacker.get<bool>();
  TEST_EQUALITY(number, 42);
  TEST_EQUALITY(text, std::string("with \0 inside", 13));
  TEST_ASSERT((reals == std::vector<double>{1.5, -2.0, std::numeric_limits<double>::denorm_min()}));
  TEST_ASSERT((texts == std::vector<std::string>{"", "b"}));
  TEST_ASSERT((table == std::map<std::string, std::vector<int>>{{"left", {1, 2}}, {"right", {}}}));
  TEST_ASSERT(none.empty());
  TEST_ASSERT(!doneTooEarly);
  TEST_ASSERT(truth);
  TEST_ASSERT(unpacker.done());
}

TEUCHOS_UNIT_TEST(Buffer, RefusesToReadBeyondTheEnd) {
  Packer packer;
  packer.put(std::int16_t(1));
  TEST_THROW(Unpacker(packer.bytes()).get<double>(), InternalError);
  TEST_THROW(Unpacker("").get<std::string>(), InternalError);
}

TEUCHOS_UNIT_TEST(Buffer, RefusesALengthThatTheMessageCannotHold) {
  Packer packer;
  packer.put(std::numeric_limits<std::size_t>::max() / 4);  // times eight bytes this wraps around to a small number
  packer.put(1.0);
  TEST_THROW(Unpacker(packer.bytes()).get<std::vector<double>>(), InternalError);
  TEST_THROW(Unpacker(packer.bytes()).get<std::vector<std::string>>(), InternalError);
  TEST_THROW(Unpacker(packer.bytes()).get<std::string>(), InternalError);
}

}  // namespace
