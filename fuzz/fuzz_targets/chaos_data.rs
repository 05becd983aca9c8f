#![no_main]

#[path = "../checks/tcm.rs"]
mod checks;

libfuzzer_sys::fuzz_target!(|input: &[u8]| checks::chaos_data(input));
