#include "adit/io/json.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/test_files.hpp"

namespace adit {
namespace {

TEST(Json, KeepsTheOrderOfKeys) {
  Json json;
  json["zulu"] = 1;
  json["alpha"]["nested"] = "text";
  json["mike"].push_back(1.5);
  json["mike"].push_back(true);
  json["zulu"] = 2;
  EXPECT_EQ(json.to_text(false), R"({"zulu":2,"alpha":{"nested":"text"},"mike":[1.5,true]})");
}

TEST(Json, NumbersThatAreNotFiniteAreNull) {
  Json json;
  json["a"] = std::numeric_limits<double>::quiet_NaN();
  json["b"] = std::numeric_limits<double>::infinity();
  json["c"] = 0.1;
  json["d"] = nullptr;
  EXPECT_EQ(json.to_text(false), R"({"a":null,"b":null,"c":0.1,"d":null})");
  EXPECT_EQ(Json::array().to_text(false), "[]");
  EXPECT_EQ(Json::object().to_text(false), "{}");
}

TEST(Json, ReadsWhatItWrites) {
  const char* text =
      R"({"count":123456789012,"big":1.8446744073709552e+19,"list":[null,-1,0.25,"\u00e9",{}],"flag":false})";
  const auto json = parse_json(text);
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(parse_json(json->to_text())->to_text(false), json->to_text(false));
  ASSERT_NE(json->find("count"), nullptr);
  EXPECT_EQ(std::get<std::int64_t>(json->find("count")->value()), 123456789012);
  EXPECT_EQ(json->find("none"), nullptr);
}

TEST(Json, BadTextIsAnError) {
  EXPECT_FALSE(parse_json("{\"a\":"));
  EXPECT_FALSE(parse_json(""));
  EXPECT_FALSE(parse_json(std::string(100000, '[')));
  EXPECT_EQ(Json("\xff").to_text(false), "\"\xef\xbf\xbd\"");
}

TEST(Json, WritesAFile) {
  const test::ScratchFolder folder;
  Json json;
  json["a"] = 1;
  ASSERT_TRUE(write_json(json, folder.path("a.json")));
  EXPECT_EQ(test::contents_of(folder.path("a.json")), "{\n  \"a\": 1\n}\n");
}

}  // namespace
}  // namespace adit
