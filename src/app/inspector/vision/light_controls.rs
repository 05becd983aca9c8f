//! The light of the hall, so that one sees a calibration fail: sliders for how bright it is and of which colour.

use bevy_egui::egui;

use super::camera_controls::{WIDTHS, slider};
use crate::app::inspector::tuner::Tuner;
use crate::world::sense::Lighting;

/// One slider.
struct LightKnob {
    name: &'static str,
    range: (f32, f32),
    tip: &'static str,
    at: fn(&mut Lighting) -> &mut f32,
}

const KNOBS: [LightKnob; 4] = [
    LightKnob {
        name: "brightness",
        range: (0.1, 3.0),
        tip: "Of the light in the hall; an exposure of 1 suits 1",
        at: |light| &mut light.brightness,
    },
    LightKnob {
        name: "red in it",
        range: (0.25, 2.5),
        tip: "Against green: above 1 lamps, below 1 daylight",
        at: |light| &mut light.red,
    },
    LightKnob {
        name: "blue in it",
        range: (0.25, 2.5),
        tip: "Against green: below 1 lamps, above 1 daylight",
        at: |light| &mut light.blue,
    },
    LightKnob {
        name: "unevenness",
        range: (0.0, 0.6),
        tip: "By what share of the mean the brightest places are brighter, and the darkest ones darker",
        at: |light| &mut light.unevenness,
    },
];

/// Shows the light with its controls; `first` is that with which the match began.
pub fn show(ui: &mut egui::Ui, first: &Lighting, light: &mut Lighting) {
    ui.weak("The light of the hall");
    let mut first = *first;
    for LightKnob { name, range, tip, at } in KNOBS {
        let tuner = Tuner { range, step: 0.0, decimals: 2, unit: "", tip, widths: WIDTHS };
        slider(ui, name, &tuner, at(light), *at(&mut first));
    }
}
