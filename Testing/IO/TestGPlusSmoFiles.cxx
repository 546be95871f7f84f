// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineReader on XML files of G+Smo: every number arrives, what is not read is named and left
// out, what is malformed is refused with its line.
#include "FileTesting.h"

using namespace testing;

namespace
{

std::string path;

ReadResult ReadAs(const std::string& text)
{
  WriteText(path, text);
  return ReadSplines(path);
}

void TestNumbers()
{
  const ReadResult result = ReadAs(files::kGPlusSmo);
  CHECK(result.errors.empty() && result.warnings.empty());
  CHECK(result.data->GetNumberOfBlocks() == 2);
  vtkStructuredGrid* curve = Net(result.data, 0);
  CHECK(Dimensions(curve)[0] == 3 && Dimensions(curve)[1] == 1);
  CHECK(NameOf(result.data, 0) == "arc & \"more\"" && NameOf(result.data, 1).empty());
  CHECK(vtkStringArray::SafeDownCast(curve->GetFieldData()->GetAbstractArray("FaceName"))
          ->GetValue(0) == "arc & \"more\"");
  CHECK(FieldValues(curve, "KnotsU") == std::vector<double>({ 0, 0, 0, 1, 1, 1 }));
  // Control points are Cartesian: not divided by the weight.
  CHECK(curve->GetPoint(1)[0] == 1 && curve->GetPoint(1)[1] == 1 && curve->GetPoint(2)[1] == 1);
  CHECK(curve->GetPointData()->GetRationalWeights()->GetComponent(1, 0) == 0.5);

  vtkStructuredGrid* surface = Net(result.data, 1);
  CHECK(Dimensions(surface)[0] == 2 && Dimensions(surface)[1] == 3);
  CHECK(FieldValues(surface, "KnotsU") == std::vector<double>({ 0, 0, 2, 2 }));
  CHECK(FieldValues(surface, "KnotsV") == std::vector<double>({ 0, 0, 1.5, 3, 3 }));
  CHECK(FieldValues(surface, "Degree") == std::vector<double>({ 1, 1 }));
  CHECK(surface->GetPoint(2)[2] == 0.1 && surface->GetPoint(3)[2] == 1e-3);
}

/// What is left out, by the words of the warning.
void TestLeftOut()
{
  const std::string good = files::kGPlusSmo;
  const std::pair<std::string, std::string> cases[] = {
    { Replaced(good, "\"TensorBSpline2\"", "\"THBSpline2\""),
      "line 14: the Geometry of type 'THBSpline2' with id '7' is left out, not read is: this "
      "type" },
    { Replaced(good, "<coefs geoDim=\"3\">", "<transform/><coefs geoDim=\"3\">"),
      "line 19: the element 'transform' in it" },
    { Replaced(good, "<KnotVector degree=\"1\">", "<KnotVector degree=\"1\" mode=\"uniform\">"),
      "line 16: the attribute 'mode' = 'uniform' of its KnotVector" },
    { Replaced(good, "<coefs geoDim=\"3\">", "<coefs geoDim=\"3\" format=\"b64float64\">"),
      "the attribute 'format' = 'b64float64' of its coefs" },
    { Replaced(good, "<coefs geoDim=\"3\">", "<coefs geoDim=\"1\">"), "its geoDim 1" },
    { Replaced(good, "<KnotVector degree=\"1\">", "<KnotVector degree=\"0\">"), "its degree 0" },
  };
  for (const auto& [text, message] : cases)
  {
    const ReadResult result = ReadAs(text);
    CHECK(result.errors.empty());
    CHECK(result.data->GetNumberOfBlocks() == 1);
    if (!Contains(result.warnings, message))
    {
      throw std::runtime_error("'" + message + "' is not in: " + result.warnings);
    }
  }
  ReadResult result = ReadAs(Replaced(good, "</xml>", "<Mesh type=\"off\"><a/></Mesh></xml>"));
  CHECK(Contains(result.warnings, "line 21: the Mesh of type 'off' is left out"));
  CHECK(result.data->GetNumberOfBlocks() == 2);
  result = ReadAs(Replaced(good, "<coefs geoDim=\"3\">", "<coefs geoDim=\"3\" format=\"ascii\">"));
  CHECK(result.warnings.empty() && result.data->GetNumberOfBlocks() == 2);
}

void TestMultiPatch()
{
  const auto with = [](const std::string& patches)
  {
    return Replaced(Replaced(files::kGPlusSmo, "id=\"7\"", "id=\"5\""), "</xml>",
      "<MultiPatch parDim=\"2\" id=\"0\">\n" + patches + "</MultiPatch></xml>");
  };
  ReadResult result = ReadAs(with("<patches type=\"id_range\">4 5</patches>"));
  CHECK(result.errors.empty() && result.warnings.empty());
  CHECK(result.data->GetNumberOfBlocks() == 2);
  result = ReadAs(with("<patches type=\"id_index\">5 4</patches><interfaces>0 1</interfaces>"));
  CHECK(result.errors.empty());
  CHECK(Contains(result.warnings, "line 21: of the MultiPatch with id '0' the patches are read"));
  CHECK(result.data->GetNumberOfBlocks() == 2);
  CheckRefused(path,
    { { with("<patches type=\"id_range\">4 2000000000</patches>"),
        "line 22: there is no Geometry with id 6" },
      { with("<patches type=\"id_range\">4</patches>"),
        "line 22: expected the first and the last" },
      { with("<patches>4 9</patches>"), "line 22: there is no Geometry with id 9" },
      { with("<patches>4 x</patches>"), "line 22: expected the id of a patch" },
      { with("<interfaces/>"),
        "line 21: expected an element patches in MultiPatch with id '0'" } });
}

void TestErrors()
{
  const std::string good = files::kGPlusSmo;
  const std::string deep = "<xml>" +
    []
  {
    std::string text;
    for (int i = 0; i < 100000; ++i)
    {
      text += "<a>";
    }
    return text;
  }();
  CheckRefused(path,
    { { "", "line 1: no element found" }, { "plain", "line 1: syntax error" },
      { "<xml/>", "it has no spline" }, { "<xml><Mesh/></xml>", "no spline; line 1: the Mesh" },
      { "<VTKFile/>", "line 1: expected the element xml of G+Smo, found 'VTKFile'" },
      { "<xml>\n<Geometry/>\n</xml>", "line 2: expected an attribute type" },
      { deep, "nested more than 50 deep" }, { Replaced(good, "</coefs>", ""), "mismatched tag" },
      { Replaced(good, "0 0 0 1 1 1", "0 0 0 1 1 x"), "line 7: expected knot 5, found 'x'" },
      { Replaced(good, "0 0 0 1 1 1", "0 0 0 1 1"), "line 7: expected 6 knots at least, found 5" },
      { Replaced(good, "0 0 0 1 1 1", "0 0 0 1 0 1"), "KnotsU[4] = 0" },
      { Replaced(good, "degree=\"2\"", ""), "line 7: expected an attribute degree of KnotVector" },
      { Replaced(good, "degree=\"2\"", "degree=\"2.5\""), "expected the attribute degree" },
      { Replaced(good, "degree=\"2\"", "degree=\"2 5\""), "expected a whole number as attribute" },
      { Replaced(good, "1 0.5 1<", "1 0.5<"), "line 9: expected 3 weights, found 2" },
      { Replaced(good, "1 0.5 1<", "1 -0.5 1<"), "RationalWeights[1] = -0.5 is not positive" },
      { Replaced(good, "   0 1</coefs>", "   0</coefs>"),
        "line 11: expected 3 control points of 2 numbers, found 5 numbers" },
      { Replaced(good, "   0 1</coefs>", "   0 inf</coefs>"), "line 12: expected number 5" },
      { Replaced(good, "\"NurbsBasis\"", "\"BSplineBasis\""),
        "line 5: expected a Basis of type 'NurbsBasis', found 'BSplineBasis'" },
      { Replaced(good, "index=\"1\"", "index=\"0\""), "line 17: expected the Basis with index 1" },
      { Replaced(good, " geoDim=\"2\"", ""), "line 11: expected an attribute geoDim of coefs" },
      { Replaced(good, "<weights>", "<weights/><weights>"), "a second element weights" } });
}

} // namespace

int TestGPlusSmoFiles(int argc, char* argv[])
{
  return Run(
    [&]
    {
      path = OutputFolder(argc, argv) + "/gismo.xml";
      TestNumbers();
      TestLeftOut();
      TestMultiPatch();
      TestErrors();
    });
}
