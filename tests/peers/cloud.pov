// cloud.pov: the cloud of cloud.tyn for POV-Ray, in the sun alone; Declare=Samples=16 says how often media are sampled.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { sky z  location <0, -6, 0.6>  right -x * image_width / image_height  up z  angle 28  look_at 0 }

// An irradiance of 5, times 1/(4 pi) of the phase function.
light_source { 1000 * <0.7, 0.3, 0.7>, rgb 5 / (4 * pi)  parallel  point_at 0  media_attenuation on }
#declare Wave = function(a, b) { sin(5 * a + 2 * sin(3 * b)) };
#declare Height = function {
  0.65 - sqrt(x * x + y * y + z * z) + 0.12 * (Wave(x, y) + Wave(y, z) + Wave(z, x))
  + 0.2 * sin(13 * x + 3) * sin(11 * y + 1) * sin(12 * z + 2)
};
#declare Share = function(h) { min(max(h / 0.4, 0), 1) };
#declare Smooth = function(s) { s * s * (3 - 2 * s) };
box {
  -1.4, 1.4
  hollow
  pigment { rgbt 1 }
  interior {
    media {
      scattering { 5, rgb 20 * 0.99 eccentricity 0.6 extinction 1 }
      absorption rgb 20 * 0.01
      density { function { Smooth(Share(Height(x, y, z))) }  color_map { [0 rgb 0] [1 rgb 1] } }
      method 3  intervals 1  samples Samples, Samples
    }
  }
}
