// Values that reach the scope they stand in, in every way that the language offers. What these tests hold is
// said by the leak checker of the sanitized build: a run lets go of all it made.
#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

TEST(Lifetimes, DefaultsThatAreBodiesEndWithTheRun) {
  const Resolved r = resolve_clean(
      R"(
def puff(stuff = { density = 1  albedo = 0.5 }, where = sphere { radius: 2 }) {
  volume { in: where  medium: stuff }
}
puff()
puff(where: box { min: (0, 0, 0)  max: (1, 1, 1) })
)");
  EXPECT_EQ(r.scene.volumes.size(), 2u);
}

TEST(Lifetimes, ListsOfBodiesEndWithTheRun) {
  const Resolved r = resolve_clean(
      R"(
def row(kinds = [sphere {}, [box { min: (0, 0, 0)  max: (1, 1, 1) }, sphere { radius: 0.5 }][0]]) {
  for k in kinds { volume { in: k  medium: { density = 1  albedo = 0.5 } } }
}
row()
)");
  EXPECT_EQ(r.scene.volumes.size(), 2u);
}

TEST(Lifetimes, DefinitionsInsideOfTemplatesEndWithTheRun) {
  const Resolved r = resolve_clean(
      R"(
def tower(levels) {
  def width(k) = 1 / (k + 1)
  medium smoke(amount = 1) { density = amount  albedo = 0.5 }
  for k in 0..<levels { volume { in: sphere { radius: width(k) }  medium: smoke(amount: k + 1) } }
}
tower(3)
)");
  EXPECT_EQ(r.scene.volumes.size(), 3u);
}

TEST(Lifetimes, AssignedBodiesEndWithTheRun) {
  resolve_text(
      R"(
def pick(k) {
  var a = sphere {}
  if k > 1 { a = box { max: (k, 1, 1) } } else { a = sphere { radius: k } }
  for i in 0..<2 { a = sphere { radius: i + k } }
  return 1
}
sphere { radius: pick(2) + pick(0.5) }
)");
}

TEST(Lifetimes, FailedRunsEndToo) {
  resolve_text("def puff(stuff = { density = missing }) { volume { in: sphere {} medium: stuff } } puff()");
}

}  // namespace UNNAMED
}  // namespace tyndall
