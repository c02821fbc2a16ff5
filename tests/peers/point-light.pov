// point-light.pov: point-light.tyn for POV-Ray; Declare=Samples=16 says how often media are sampled.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { sky z  location <0, -9, 0>  right -x * image_width / image_height  up z  angle 36  look_at 0 }

// An intensity of 100/(4 pi) W/sr, times the phase function, which POV-Ray takes for 1: its fall is that of
// 2 / (1 + (d / 0.01)^2).
light_source {
  <0.3, -0.2, 0.4>, rgb 100 / (4 * pi) / (4 * pi) / 2e-4
  fade_distance 0.01  fade_power 2
  media_attenuation on
}
box {
  -2, 2
  hollow
  pigment { rgbt 1 }
  interior {
    media { scattering { 1, rgb 0.45 extinction 1 }  absorption rgb 0.05  method 3  intervals 1  samples Samples, Samples }
  }
}
// Without a surface on the way POV-Ray does not let media attenuate the light.
sphere { <0.3, -0.2, 0.4>, 0.01  hollow  pigment { rgbt 1 }  interior { } }
