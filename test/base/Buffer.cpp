#include <suture/base/Buffer.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <limits>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Buffer, GivesBackWhatWasPutInTheSameOrder) {
  Packer packer;
  packer.put(42);
  packer.put(std::string("with \0 inside", 13));
  packer.put(std::vector<double>{1.5, -2.0, std::numeric_limits<double>::denorm_min()});
  packer.put(std::vector<std::string>{"", "b"});
  packer.put(std::map<std::string, std::vector<int>>{{"left", {1, 2}}, {"right", {}}});
  packer.put(std::vector<double>{});
  packer.put(true);

  Unpacker unpacker(packer.bytes());
  // Into variables first: TEST_EQUALITY evaluates what it is given more than once.
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

#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
// What stood in the memory between the members does not come with them: messages and files are the same each time.
TEUCHOS_UNIT_TEST(Buffer, BytesBetweenMembersAreZero) {
  struct Padded {
    char letter;
    double number;
    std::array<bool, 3> flags;
  };
  const auto packed = [](int filling) {
    Packer packer;
    std::vector<Padded> all(2);
    std::memset(static_cast<void*>(all.data()), filling, 2 * sizeof(Padded));
    for (Padded& one : all) one.letter = 'a', one.number = -2.5, one.flags = {true, false, true};
    packer.put(all);
    packer.put(all[1]);
    packer.put(std::array<Padded, 2>{all[0], all[1]});
    return packer.bytes();
  };
  TEST_ASSERT(packed(0x55) == packed(0xAA));
  Unpacker unpacker(packed(0x55));
  const auto back = unpacker.get<std::vector<Padded>>();
  TEST_ASSERT(back[1].letter == 'a' && back[1].number == -2.5 && back[1].flags[2] && !back[1].flags[1]);
}
#endif
#endif

TEUCHOS_UNIT_TEST(Buffer, RefusesToReadBeyondTheEnd) {
  Packer packer;
  packer.put(std::int16_t(1));
  TEST_THROW(Unpacker(packer.bytes()).get<double>(), InternalError);
  TEST_THROW(Unpacker("").get<std::string>(), InternalError);
}

TEUCHOS_UNIT_TEST(Buffer, RefusesALengthThatTheMessageCannotHold) {
  Packer packer;
  packer.put(std::numeric_limits<std::size_t>::max() / 4);  // times eight bytes it would wrap around to a small number
  packer.put(1.0);
  TEST_THROW(Unpacker(packer.bytes()).get<std::vector<double>>(), InternalError);
  TEST_THROW(Unpacker(packer.bytes()).get<std::vector<std::string>>(), InternalError);
  TEST_THROW(Unpacker(packer.bytes()).get<std::string>(), InternalError);
}

}  // namespace
