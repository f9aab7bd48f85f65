//! Tells Zed how the language server of part programs is started.

use zed_extension_api::{register_extension, Command, Extension, LanguageServerId, Result, Worktree};

struct Part;

impl Extension for Part {
    fn new() -> Self {
        Part
    }

    fn language_server_command(&mut self, _: &LanguageServerId, worktree: &Worktree) -> Result<Command> {
        let command = worktree
            .which("partc")
            .ok_or("The program partc is not on the path.")?;
        Ok(Command {
            command,
            args: vec!["lsp".to_string()],
            env: worktree.shell_env(),
        })
    }
}

register_extension!(Part);
