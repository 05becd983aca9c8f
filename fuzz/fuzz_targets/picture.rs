#![no_main]

#[path = "../checks/pictures.rs"]
mod checks;
#[path = "../checks/shipped.rs"]
mod shipped;

libfuzzer_sys::fuzz_target!(|input: &[u8]| checks::picture(input));
