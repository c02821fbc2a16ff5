// Every example of the language's description, read as it stands and with all line breaks replaced by spaces.
#include <gtest/gtest.h>

#include <regex>

#include "reading.h"

namespace tyndall::syntax {
namespace UNNAMED {

struct Example {
  const char* text;
  const char* tree;
};

constexpr Example examples[] = {
    {R"tyn(
let radius = 1.3                                             // a name for a value
def swirl(p, t) = rotate_y(p, 0.6rad * t * exp(-length(p)))  // a function: usable in scenes and bodies
def layers(p) = {                                            // a function with steps
  var sum = 0
  for i in 0..<4 { sum = sum + fbm(p * 2^i, octaves: 3) / 2^i }
  return sum
}
def lamp(at, power = 40) {                                   // a template: places things when called as a statement
  light sphere { center: at  radius: 5cm  power: power }
}
medium cloud(height = 1, seed = 0) {                         // a volume shader; parameters have defaults
  let q = swirl(p, time)
  let billow = fbm(q * 2.3, octaves: 6, seed: seed)
  density = 20 * smoothstep(1, 0.4, length(q / (1, height, 1)) + 0.35 * billow)
  albedo  = 0.99
  phase   = mix(hg(0.8), hg(-0.3), 0.2)
}
material tiles(size = 1) {                                   // a surface shader, by the same rules
  base_color = if checker(p.xz / size) then 0.8 else 0.2
  roughness  = 0.4
}
object bench { }                                           // a prototype; `place bench { transform: … }` instances it
)tyn",
     R"tree((file
  (let radius 1.3)
  (function swirl (p, t) (call rotate_y p (* (* 0.6rad t) (call exp (- (call length p))))))
  (function layers (p)
    (var sum 0)
    (for i (..< 0 4)
      (set sum (+ sum (/ (call fbm (* p (^ 2 i)) octaves: 3) (^ 2 i)))))
    (return sum))
  (template lamp (at, power = 40)
    (thing light sphere
      (parameter center at)
      (parameter radius 0.05m)
      (parameter power power)))
  (medium cloud (height = 1, seed = 0)
    (let q (call swirl p time))
    (let billow (call fbm (* q 2.3) octaves: 6 seed: seed))
    (set density (* 20 (call smoothstep 1 0.4 (+ (call length (/ q (tuple 1 height 1))) (* 0.35 billow)))))
    (set albedo 0.99)
    (set phase (call mix (call hg 0.8) (call hg (- 0.3)) 0.2)))
  (material tiles (size = 1)
    (set base_color (if (call checker (/ (member p xz) size)) 0.8 0.2))
    (set roughness 0.4))
  (object bench))
)tree"},
    {R"tyn(
render    { resolution: (640, 360)  samples: 64  step: 0.05  light_samples: 2  bounces: 8 }
animation { fps: 24  frames: 1..48  shutter: 180deg }
camera perspective { from: (0, 1, 6)  to: (0, 1, 0)  fov: 40deg  exposure: 0 }
light sphere { center: (2, 3, 1)  radius: 0.2  power: 100 }
sphere { center: (0, 1, 0)  radius: 0.5  material: tiles(size: 0.5) }
volume { in: sphere { radius: 1.3 }  medium: cloud(height: 0.7)  transform: translate((0, 1, 0)) }
gltf "helmet.glb" { transform: scale(2) * rotate_y(30deg) }
group { transform: rotate_y(90deg * time)  lamp((1, 2, 0))  place bench {} }
for i in 0..<8 { lamp((cos(45deg * i), 2, sin(45deg * i)), power: 10 + i) }
if detail > 1 { include "leaves.tyn" }
)tyn",
     R"tree((file
  (thing render
    (parameter resolution (tuple 640 360))
    (parameter samples 64)
    (parameter step 0.05)
    (parameter light_samples 2)
    (parameter bounces 8))
  (thing animation
    (parameter fps 24)
    (parameter frames (.. 1 48))
    (parameter shutter 3.141592653589793rad))
  (thing camera perspective
    (parameter from (tuple 0 1 6))
    (parameter to (tuple 0 1 0))
    (parameter fov 0.6981317007977318rad)
    (parameter exposure 0))
  (thing light sphere
    (parameter center (tuple 2 3 1))
    (parameter radius 0.2)
    (parameter power 100))
  (thing sphere
    (parameter center (tuple 0 1 0))
    (parameter radius 0.5)
    (parameter material (call tiles size: 0.5)))
  (thing volume
    (parameter in (thing sphere
      (parameter radius 1.3)))
    (parameter medium (call cloud height: 0.7))
    (parameter transform (call translate (tuple 0 1 0))))
  (thing gltf "helmet.glb"
    (parameter transform (* (call scale 2) (call rotate_y 0.5235987755982988rad))))
  (thing group
    (parameter transform (call rotate_y (* 1.5707963267948966rad time)))
    (place_call (call lamp (tuple 1 2 0)))
    (place bench))
  (for i (..< 0 8)
    (place_call (call lamp (tuple (call cos (* 0.7853981633974483rad i)) 2 (call sin (* 0.7853981633974483rad i))) power: (+ 10 i))))
  (if (> detail 1)
    (include "leaves.tyn")))
)tree"},
    {R"tyn(
let smoke = grid("smoke.vdb", "density")
medium plume() { density = 4 * smoke(p) * (0.6 + 0.4 * fbm(p * 9))  albedo = 0.9 }
volume { in: bounds(smoke)  medium: plume }
)tyn",
     R"tree((file
  (let smoke (call grid "smoke.vdb" "density"))
  (medium plume ()
    (set density (* (* 4 (call smoke p)) (+ 0.6 (* 0.4 (call fbm (* p 9))))))
    (set albedo 0.9))
  (thing volume
    (parameter in (call bounds smoke))
    (parameter medium plume)))
)tree"},
    {R"tyn(
// Light through a drifting cloud.
render    { resolution: (640, 360)  samples: 64  step: 0.05  light_samples: 2  bounces: 8 }
animation { fps: 24  frames: 1..48  shutter: 180deg }
camera perspective { from: (0, 1, 6 - 0.2 * time)  to: (0, 1, 0)  fov: 40deg }

medium cloud(height = 1) {
  density = 20 * smoothstep(1, 0.4, length(p / (1, height, 1)) + 0.35 * fbm(p * 2.3 - (0, 0.4 * time, 0), octaves: 6))
  albedo  = 0.99
  phase   = hg(0.6)
}
volume { in: sphere { radius: 1.4 }  medium: cloud(height: 0.7)  transform: translate((0, 1, 0)) }
light sphere { center: (2, 3, 1)  radius: 0.2  power: 100 }
light environment { radiance: (0.05, 0.08, 0.12) }
)tyn",
     R"tree((file
  (thing render
    (parameter resolution (tuple 640 360))
    (parameter samples 64)
    (parameter step 0.05)
    (parameter light_samples 2)
    (parameter bounces 8))
  (thing animation
    (parameter fps 24)
    (parameter frames (.. 1 48))
    (parameter shutter 3.141592653589793rad))
  (thing camera perspective
    (parameter from (tuple 0 1 (- 6 (* 0.2 time))))
    (parameter to (tuple 0 1 0))
    (parameter fov 0.6981317007977318rad))
  (medium cloud (height = 1)
    (set density (* 20 (call smoothstep 1 0.4 (+ (call length (/ p (tuple 1 height 1))) (* 0.35 (call fbm (- (* p 2.3) (tuple 0 (* 0.4 time) 0)) octaves: 6))))))
    (set albedo 0.99)
    (set phase (call hg 0.6)))
  (thing volume
    (parameter in (thing sphere
      (parameter radius 1.4)))
    (parameter medium (call cloud height: 0.7))
    (parameter transform (call translate (tuple 0 1 0))))
  (thing light sphere
    (parameter center (tuple 2 3 1))
    (parameter radius 0.2)
    (parameter power 100))
  (thing light environment
    (parameter radiance (tuple 0.05 0.08 0.12))))
)tree"},
};

TEST(LanguageExamples, AreRead) {
  for (const Example& example : examples) {
    const Reading reading(example.text);
    EXPECT_EQ(reading.errors(), "");
    EXPECT_EQ(reading.printed(), example.tree);
  }
}

TEST(LanguageExamples, AreReadOnOneLine) {
  for (const Example& example : examples) {
    std::string text = std::regex_replace(example.text, std::regex("//[^\n]*"), "");
    for (char& c : text)
      if (c == '\n') c = ' ';
    const Reading reading(text);
    EXPECT_EQ(reading.errors(), "");
    EXPECT_EQ(reading.printed(), example.tree);
  }
}

}  // namespace
}  // namespace tyndall::syntax
