// sphere-light.pov: sphere-light.tyn for POV-Ray; Declare=Samples=16 says how often media are sampled.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { sky z  location <4, -8, 1.5>  right -x * image_width / image_height  up z  angle 36  look_at 0 }

// Intensity and phase function as in point-light.pov; 5 x 5 lights on a disc that faces the lit point.
light_source {
  <0, 1.2, 0.5>, rgb 100 / (4 * pi) / (4 * pi) / 2e-4
  fade_distance 0.01  fade_power 2
  area_light 0.2 * x, 0.2 * z, 5, 5  circular  orient  adaptive 1
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
sphere { <0, 0.1, 0.2>, 0.4  pigment { rgb 0 }  finish { ambient 0 diffuse 0 } }
// Without a surface on the way POV-Ray does not let media attenuate the light.
sphere { <0, 1.2, 0.5>, 0.11  hollow  pigment { rgbt 1 }  interior { } }
