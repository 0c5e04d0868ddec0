#include "io/usd/compose/UsdExpression.h"

#include <gtest/gtest.h>

namespace penumbra {

namespace {

UsdNamedValue text(const char* name, const char* value) {
    return {name, "string", {{UsdKind::string}, std::vector<std::string>{value}}};
}

const UsdDictionary& variables() {
    static const UsdDictionary all{
        text("SHOT", "s1"),
        text("INNER", "`\"${SHOT}x\"`"),
        text("LOOP", "`\"${LOOP}\"`"),
        {"ON", "bool", {{UsdKind::boolean}, std::vector<std::uint8_t>{1}}},
        {"N", "int", {{UsdKind::int32}, std::vector<std::int32_t>{3}}},
        {"LIST", "string", {{UsdKind::string, 1, 1, true}, std::vector<std::string>{"a", "b"}}},
    };
    return all;
}

std::string value(const std::string& expression) {
    const UsdEvaluated result = evaluateUsdText(expression, variables());
    return result.error.empty() ? result.text : "error";
}

} // namespace

TEST(UsdExpression, PlainTextStaysWhatItIs) {
    EXPECT_EQ(value("a.usd"), "a.usd");
    EXPECT_EQ(value("${SHOT}"), "${SHOT}");
}

TEST(UsdExpression, VariablesAreSubstituted) {
    EXPECT_EQ(value("`\"./${SHOT}.usd\"`"), "./s1.usd");
    EXPECT_EQ(value("`${SHOT}`"), "s1");
    EXPECT_EQ(value("`'${INNER}'`"), "s1x"); // its value is an expression itself
    EXPECT_EQ(value("`\"a\\${b\"`"), "a${b");
}

TEST(UsdExpression, FunctionsDecide) {
    EXPECT_EQ(value("`if(${ON}, \"yes\", \"no\")`"), "yes");
    EXPECT_EQ(value("`if(not(${ON}), ${NOWHERE}, \"no\")`"),
              "no"); // nobody evaluates the variable
    EXPECT_EQ(value("`if(and(eq(${SHOT}, \"s1\"), gt(${N}, 2)), \"both\")`"), "both");
    EXPECT_EQ(value("`if(or(${ON}, ${NOWHERE}), \"one\")`"), "one");
    EXPECT_EQ(value("`if(contains(${LIST}, \"b\"), at(${LIST}, -1), \"\")`"), "b");
    EXPECT_EQ(value("`if(eq(len(${LIST}), 2), \"two\")`"), "two");
    EXPECT_EQ(value("`if(defined(SHOT, NOWHERE), \"all\", \"not all\")`"), "not all");
    EXPECT_EQ(value("`if(leq(1, 1), if(lt(2, 1), \"a\", \"b\"))`"), "b");
}

TEST(UsdExpression, NoneIsNothingAndSilent) {
    EXPECT_EQ(value("`None`"), "");
    EXPECT_EQ(value("`if(False, \"a\")`"), "");
}

TEST(UsdExpression, FaultsAreErrors) {
    for (const char* wrong :
         {"`${NOWHERE}`", "`\"a`", "`\"a\"", "`", "``", "`f(1)`", "`if(1, \"a\")`", "`3`",
          "`\"${LIST}\"`", "`\"${LOOP}\"`", "`lt(1, \"a\")`", "`[1, [2]]`", "`at(${LIST}, 2)`",
          "`\"a\" \"b\"`", "`99999999999999999999`"})
        EXPECT_EQ(value(wrong), "error") << wrong;
    std::string deep = "`";
    for (int i = 0; i < 100'000; ++i) deep += "not(";
    EXPECT_EQ(value(deep + "`"), "error");
}

} // namespace penumbra
