#include "floc/picture/plain_svg.h"

#include <gtest/gtest.h>

namespace floc {
namespace {

TEST(PlainSvg, NumbersWhatCairoCountsThroughTheProcess) {
  EXPECT_EQ(plain_svg(R"svg(<g id="surface12"><use xlink:href="#image7"/><image id="image7"/></g>)svg"),
            R"svg(<g id="surface1"><use xlink:href="#image2"/><image id="image2"/></g>)svg");
}

TEST(PlainSvg, LeavesOtherNamesAndTextAlone) {
  const std::string svg = R"svg(<symbol id="glyph0-3"/><g clip-path="url(#clip4)">surface9 image3</g>)svg";
  EXPECT_EQ(plain_svg(svg), svg);
  const std::string data = R"svg(<image xlink:href="data:image/png;base64,id1.2345678"/>)svg";
  EXPECT_EQ(plain_svg(data), data);
}

TEST(PlainSvg, CoordinatesOfPathsHaveTwoDecimals) {
  EXPECT_EQ(plain_svg(R"svg(<path d="M 1.234567 -0.001 L 10.5 200 C 3.999 1e-9 0.25 0.1 -7.125 6"/>)svg"),
            R"svg(<path d="M 1.23 0 L 10.5 200 C 4 0 0.25 0.1 -7.12 6"/>)svg");
  // The function shortens numbers, but line widths and matrices keep all their digits.
  const std::string kept =
      R"svg(<path style="stroke-width:0.123456" transform="matrix(0.123456,0,0,1,0,0)"/>)svg";
  EXPECT_EQ(plain_svg(kept), kept);
}

}  // namespace
}  // namespace floc
