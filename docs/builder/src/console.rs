//! Blocks ```` ```console ```` of a chapter: their commands are run, and their output is compared or written.
//!
//! A block ```` ```toml,file=NAME ```` is written to the chapter's folder before the commands below it. A command that
//! shall fail stands in a block ```` ```console,fails ````.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Runs the commands of a chapter in its folder.
#[derive(Debug)]
pub struct Console {
    /// Folder of the program `rotordyn`.
    pub program_folder: PathBuf,
    /// The model files that the repository has, seen as `models` in every folder.
    pub models: PathBuf,
}

/// A chapter after its commands were run.
#[derive(Debug)]
pub struct Ran {
    /// The chapter with the output of its commands.
    pub text: String,
    /// Commands whose output is not the one shown: command, shown, printed.
    pub changed: Vec<[String; 3]>,
    pub commands: usize,
}

/// One fenced block: its lines are `text[first..last]`, between the fences.
struct Block {
    info: String,
    first: usize,
    last: usize,
}

impl Console {
    /// Runs every block of a chapter, in order.
    ///
    /// # Errors
    /// A command that cannot be started, or ends with another exit code than the block says.
    pub fn run(&self, chapter: &str, folder: &Path) -> Result<Ran, String> {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let models = folder.join("models");
        if !models.exists() {
            std::os::unix::fs::symlink(&self.models, &models).map_err(|error| format!("models: {error}"))?;
        }
        let lines: Vec<&str> = chapter.lines().collect();
        let mut ran = Ran { text: String::new(), changed: Vec::new(), commands: 0 };
        let mut done = 0;
        for block in blocks(&lines)? {
            let body = &lines[block.first..block.last];
            let mut words = block.info.split(',');
            let kind = words.next().unwrap_or_default();
            let options: Vec<&str> = words.collect();
            if let Some(name) = options.iter().find_map(|option| option.strip_prefix("file=")) {
                let path = folder.join(name);
                fs::write(&path, body.join("\n") + "\n").map_err(|e| format!("{}: {e}", path.display()))?;
            }
            if kind != "console" {
                continue;
            }
            push_lines(&mut ran.text, &lines[done..block.first]);
            for (command, shown) in commands(body)? {
                let printed = self.output(command, folder, options.contains(&"fails"))?;
                ran.text += &format!("$ {command}\n{printed}");
                ran.commands += 1;
                let shown: String = shown.iter().map(|line| format!("{line}\n")).collect();
                if shown != printed {
                    ran.changed.push([command.into(), shown, printed]);
                }
            }
            done = block.last;
        }
        push_lines(&mut ran.text, &lines[done..]);
        Ok(ran)
    }

    /// What a command prints, both streams as a terminal shows them.
    fn output(&self, command: &str, folder: &Path, fails: bool) -> Result<String, String> {
        let path = std::env::var("PATH").unwrap_or_default();
        let shell = Command::new("bash")
            .args(["-o", "pipefail", "-c", &format!("{{ {command}\n}} 2>&1")])
            .current_dir(folder)
            .env("PATH", format!("{}:{path}", self.program_folder.display()))
            .env("LC_ALL", "C.UTF-8")
            .env("COLUMNS", "100")
            .env("NO_COLOR", "1")
            .stdin(Stdio::null())
            .output()
            .map_err(|error| format!("bash: {error}"))?;
        let printed: String = String::from_utf8_lossy(&shell.stdout)
            .lines()
            .map(|line| format!("{}\n", line.trim_end()))
            .collect();
        // A command whose output is cut by `head` ends by a closed pipe.
        let cut = command.contains("| head") || command.contains("| sed");
        if shell.status.success() == fails && !cut {
            return Err(format!("`{command}` ended with {}:\n{printed}", shell.status));
        }
        Ok(printed)
    }
}

fn push_lines(out: &mut String, lines: &[&str]) {
    for line in lines {
        out.push_str(line);
        out.push('\n');
    }
}

/// Fenced blocks that begin at the margin.
fn blocks(lines: &[&str]) -> Result<Vec<Block>, String> {
    let mut out = Vec::new();
    let mut open: Option<(String, String, usize)> = None;
    for (k, line) in lines.iter().enumerate() {
        let ticks = line.len() - line.trim_start_matches('`').len();
        match &open {
            None if ticks >= 3 => open = Some((line[..ticks].into(), line[ticks..].trim().into(), k + 1)),
            Some((fence, info, first)) if line.trim_end() == fence => {
                out.push(Block { info: info.clone(), first: *first, last: k });
                open = None;
            }
            _ => {}
        }
    }
    match open {
        None => Ok(out),
        Some((_, _, first)) => Err(format!("the block that begins in line {first} has no end")),
    }
}

/// Commands of a block with the output shown.
fn commands<'t>(body: &[&'t str]) -> Result<Vec<(&'t str, Vec<&'t str>)>, String> {
    let mut out: Vec<(&str, Vec<&str>)> = Vec::new();
    for line in body {
        match (line.strip_prefix("$ "), out.last_mut()) {
            (Some(command), _) => out.push((command, Vec::new())),
            (None, Some((_, shown))) => shown.push(line),
            (None, None) => {
                return Err(format!("a console block begins with `{line}`, not with `$ command`"));
            }
        }
    }
    Ok(out)
}

/// Blocks as a reader sees them: without the words for this program.
pub fn without_options(chapter: &str) -> String {
    chapter
        .lines()
        .map(|line| match (line.strip_prefix("```console,"), line.split_once(",file=")) {
            (Some(_), _) => "```console\n".into(),
            (_, Some((fence, name))) if fence.starts_with("```") => format!("`{name}`:\n\n{fence}\n"),
            _ => format!("{line}\n"),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(chapter: &str) -> Result<Ran, String> {
        let folder = tempfile::tempdir().unwrap();
        let console = Console { program_folder: "/nowhere".into(), models: folder.path().into() };
        console.run(chapter, &folder.path().join("chapter"))
    }

    #[test]
    fn output_is_written_and_a_change_is_told() {
        let chapter = "# A\n\n```toml,file=a.txt\none = 1\n```\n\n```console\n$ cat a.txt\n$ echo two  \nthree\n```\nend\n";
        let ran = run(chapter).unwrap();
        assert_eq!(ran.commands, 2);
        assert_eq!(ran.changed.len(), 2);
        assert!(ran.text.contains("$ cat a.txt\none = 1\n$ echo two  \ntwo\n```\nend\n"), "{}", ran.text);
        assert!(run(&ran.text).unwrap().changed.is_empty());
        assert!(without_options(&ran.text).contains("`a.txt`:\n\n```toml\none = 1\n"));
    }

    #[test]
    fn exit_codes_are_as_stated() {
        assert!(run("```console\n$ false\n```\n").unwrap_err().contains("`false`"));
        assert!(run("```console,fails\n$ true\n```\n").is_err());
        assert!(run("```console,fails\n$ false\n```\n").is_ok());
        assert!(run("```console\nno command\n```\n").is_err());
        assert!(run("```console\n$ true\n").unwrap_err().contains("no end"));
    }
}
