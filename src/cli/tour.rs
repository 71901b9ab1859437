//! `hopfscope tour`: a tour of the explorer.

use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;

use super::config::Settings;
use super::explore::go;
use super::failure::Failure;
use super::look::Looks;
use crate::scene::plain;
use crate::session::replay::Instruction;
use crate::session::{Msg, Session, Size};

/// Guided tour of the explorer: the keys named in a caption work, any other key continues, Esc leaves
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    looks: Looks,
    #[command(flatten)]
    settings: Settings,
}

impl Arguments {
    pub fn run(&self) -> Result<ExitCode, Failure> {
        let config = self.settings.read()?;
        let mut session = Session::new(plain(), Size { width: 80, height: 24 });
        session.display = self.looks.wishes(&config);
        session.keymap = Arc::new(config.keymap);
        go(session, &[Instruction::Give(Msg::Run("tour".to_owned()))], None, false)
    }
}
