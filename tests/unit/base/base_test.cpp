// Hash, bits, contracts: what the determinism of everything above is judged with.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "endowire/base/bits.hpp"
#include "endowire/base/contract.hpp"
#include "endowire/base/error.hpp"
#include "endowire/base/hash.hpp"

namespace endowire::base {
namespace {

template <class... Values>
std::uint64_t hash_of(Values... values) {
  Hash h;
  (h.add(values), ...);
  return h.value();
}

// Breaks with another offset basis, prime or byte order: these are the published values of FNV-1a.
TEST(Hash, IsFnv1a) {
  EXPECT_EQ(Hash().value(), 0xcbf29ce484222325ULL);
  // Eight zero bytes: the basis times the prime, eight times, since x ^ 0 = x.
  std::uint64_t expected = 0xcbf29ce484222325ULL;
  for (int i = 0; i < 8; ++i) expected *= 0x100000001b3ULL;
  EXPECT_EQ(hash_of(std::uint64_t{0}), expected);
  // Byte 1 first: "\x01" then seven zeros. Reading the word from its other end gives another number.
  expected = (0xcbf29ce484222325ULL ^ 1U) * 0x100000001b3ULL;
  for (int i = 0; i < 7; ++i) expected *= 0x100000001b3ULL;
  EXPECT_EQ(hash_of(std::uint64_t{1}), expected);
}

// Breaks when numbers are compared by value or rounded instead of by their bits.
TEST(Hash, SeesEveryBitOfANumber) {
  EXPECT_NE(hash_of(0.0), hash_of(-0.0));
  EXPECT_NE(hash_of(1.0), hash_of(std::nextafter(1.0, 2.0)));
  EXPECT_NE(hash_of(std::numeric_limits<double>::denorm_min()), hash_of(0.0));
  EXPECT_EQ(hash_of(0.1 + 0.2), hash_of(0.30000000000000004));
}

// Breaks with a sum or xor in place of a chain.
TEST(Hash, SeesTheOrder) {
  EXPECT_NE(hash_of(1.0, 2.0), hash_of(2.0, 1.0));
  EXPECT_NE(hash_of(1.0), hash_of(1.0, 0.0));
}

// Breaks when the value is converted rather than its bits copied.
TEST(Bits, AreThoseOfIeee754) {
  EXPECT_EQ(bits_as<std::uint64_t>(1.0), 0x3ff0000000000000ULL);
  EXPECT_EQ(bits_as<std::uint64_t>(-2.5), 0xc004000000000000ULL);
  EXPECT_EQ(bits_as<double>(std::uint64_t{0x7ff0000000000000ULL}), std::numeric_limits<double>::infinity());
}

// Breaks when the macro loses the expression, the reason or the place, or is off outside of release builds.
TEST(Contract, NamesExpressionReasonAndPlace) {
#ifdef NDEBUG
  GTEST_SKIP() << "contracts are off in release builds";
#else
  const int rods = 1;
  try {
    ENDOWIRE_EXPECTS(rods >= 2, "a chain has at least two rods");
    FAIL() << "the contract holds";
  } catch (const ContractError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("rods >= 2"), std::string::npos) << text;
    EXPECT_NE(text.find("a chain has at least two rods"), std::string::npos) << text;
    EXPECT_NE(text.find("base_test.cpp:"), std::string::npos) << text;
  }
  EXPECT_NO_THROW(ENDOWIRE_EXPECTS(rods == 1, "holds"));
#endif
}

// Breaks when bad input and our own bugs become one kind: the command line tells them apart by type.
TEST(Errors, AreTwoKinds) {
  EXPECT_THROW(throw InputError("x"), std::runtime_error);
  EXPECT_FALSE((std::is_base_of_v<InputError, ContractError>));
  EXPECT_FALSE((std::is_base_of_v<ContractError, InputError>));
}

}  // namespace
}  // namespace endowire::base
