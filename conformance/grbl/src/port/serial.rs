//! Opens a serial device: 115200 bit/s, 8 data bits, no parity, 1 stop bit, no flow control.

use std::fs::File;
use std::io;
use std::path::Path;

use rustix::fs::{Mode, OFlags, open};
use rustix::termios::{
    ControlModes, OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr,
};

/// Bits per second of the line.
pub const BITS_PER_SECOND: u32 = 115_200;

/// Opens a device and sets its line up.
///
/// The line stays as it is when the device is closed, so that a board whose reset is wired to it does not restart then.
pub(super) fn open_device(path: &Path) -> io::Result<File> {
    let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let device = open(path, flags, Mode::empty())?;
    let mut line = tcgetattr(&device)?;
    line.make_raw();
    line.control_modes |= ControlModes::CREAD | ControlModes::CLOCAL | ControlModes::CS8;
    line.control_modes -=
        ControlModes::HUPCL | ControlModes::CSTOPB | ControlModes::PARENB | ControlModes::CRTSCTS;
    line.set_speed(BITS_PER_SECOND)?;
    tcsetattr(&device, OptionalActions::Now, &line)?;
    tcflush(&device, QueueSelector::IOFlush)?;
    Ok(File::from(device))
}
