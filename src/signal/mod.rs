//! Signal processing on slices and a sample rate; knows no rotor.
