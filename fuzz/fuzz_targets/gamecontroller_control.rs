#![no_main]

use libfuzzer_sys::fuzz_target;

#[allow(dead_code)]
#[path = "../checks/gamecontroller.rs"]
mod gamecontroller;

fuzz_target!(|data: &[u8]| gamecontroller::control(data));
