#![no_main]

#[path = "../checks/files.rs"]
mod checks;
#[path = "../checks/shipped.rs"]
mod shipped;

libfuzzer_sys::fuzz_target!(|input: &[u8]| checks::asset(input));
