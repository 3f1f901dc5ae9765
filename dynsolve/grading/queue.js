"use strict";
const place = "dynsolve queue " + location.pathname;
const entries = [...document.querySelectorAll("article")];
const answers = [...document.querySelectorAll("fieldset")];
const marksOf = (answer) => answer.querySelector("input");
const commentOf = (answer) => answer.querySelector("textarea");
const status = document.getElementById("status");

// What was filled in is kept in this browser, by what identifies the hand-in and the answer.
let kept = {};
try { kept = JSON.parse(localStorage.getItem(place)) ?? {}; } catch { kept = {}; }
for (const answer of answers) {
  const [marks, comment] = kept[answer.id] ?? ["", ""];
  marksOf(answer).value = marks;
  commentOf(answer).value = comment;
}
const keep = (answer) => {
  const said = [marksOf(answer).value, commentOf(answer).value];
  if (said.some(Boolean)) kept[answer.id] = said; else delete kept[answer.id];
  try { localStorage.setItem(place, JSON.stringify(kept)); } catch { /* then it is kept until the page is closed */ }
};

const marksIn = (text) => text.trim().replace(",", ".");
const isMarks = (text, of) => {
  const found = /^(\d+(?:\.\d+)?)(?:\/([1-9]\d*))?$/.exec(marksIn(text));
  return found !== null && Number(found[1]) / Number(found[2] ?? 1) <= Number(of) + 1e-4;
};
const isWrong = (answer) => marksOf(answer).value.trim() !== "" && !isMarks(marksOf(answer).value, answer.dataset.of);
const isFilled = (answer) => marksOf(answer).value.trim() !== "" || commentOf(answer).value.trim() !== "";

// queue.csv: every row as it came, with the marks and the comment in it.
const safe = (cell) => (/^\s*[=+\-@\t\r\n|%\uff1d\uff0b\uff0d\uff20]/.test(cell) ? "'" + cell : cell);
const quoted = (cell) => (/[",\r\n]/.test(cell) ? '"' + cell.replaceAll('"', '""') + '"' : cell);
const queueCsv = () => {
  const lines = [["student", "problem", "answer", "marks", "comment", "of", "reason"]];
  for (const row of document.querySelectorAll("[data-row]")) {
    const [student, problem, answer, of, reason] = JSON.parse(row.dataset.row);
    const isAnswer = row.matches("fieldset");
    if (isAnswer && "extra" in row.dataset && !isFilled(row)) continue;
    const said = isAnswer ? [marksIn(marksOf(row).value), safe(commentOf(row).value.trim().replace(/\s+/g, " "))] : ["", ""];
    lines.push([student, problem, answer, ...said, of, reason]);
  }
  return lines.map((line) => line.map(quoted).join(",") + "\n").join("");
};
const save = () => {
  const wrong = answers.find(isWrong);
  if (wrong) {
    wrong.closest("article").hidden = false;
    marksOf(wrong).focus();
    status.textContent = "Not saved: these marks are no number from 0 to " + wrong.dataset.of + ".";
    return;
  }
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([queueCsv()], { type: "text/csv" }));
  link.download = "queue.csv";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  status.textContent = "queue.csv is where your browser saves downloads; " + counted();
};

const counted = () => answers.filter(isFilled).length + " of " + answers.filter((a) => !("extra" in a.dataset)).length + " filled in";
const filters = document.getElementById("filters");
const refresh = () => {
  const text = filters.elements.text.value.trim().toLocaleLowerCase();
  const { problem, answer, open } = filters.elements;
  for (const entry of entries) {
    const own = [...entry.querySelectorAll("fieldset")];
    entry.dataset.state = own.some(isWrong) ? "wrong" : own.some(isFilled) ? "filled" : "open";
    entry.hidden = !(
      (!problem.value || entry.dataset.problem === problem.value) &&
      (!answer.value || own.some((one) => one.dataset.answer === answer.value)) &&
      (!open.checked || entry.dataset.state !== "filled" || entry.contains(document.activeElement)) &&
      (!text || entry.textContent.toLocaleLowerCase().includes(text))
    );
  }
  for (const one of answers) marksOf(one).setAttribute("aria-invalid", String(isWrong(one)));
  status.textContent = counted() + ", " + entries.filter((e) => !e.hidden).length + " of " + entries.length + " entries shown";
};

const move = (by) => {
  const shown = entries.filter((entry) => !entry.hidden);
  const at = shown.findIndex((entry) => entry.contains(document.activeElement));
  const next = shown[at < 0 ? 0 : Math.min(Math.max(at + by, 0), shown.length - 1)];
  if (!next) return;
  next.querySelector("input").focus({ preventScroll: true });
  next.scrollIntoView();
};
document.addEventListener("keydown", (event) => {
  const isTyping = event.target.matches("input, textarea, select");
  const by = { ArrowDown: 1, ArrowUp: -1 }[event.key] ?? 0;
  const byLetter = { j: 1, k: -1 }[event.key] ?? 0;
  if (by && event.altKey) move(by);
  else if (byLetter && !isTyping && !event.ctrlKey && !event.metaKey && !event.altKey) move(byLetter);
  else if (event.key === "s" && (event.ctrlKey || event.metaKey)) save();
  else return;
  event.preventDefault();
});
document.addEventListener("input", (event) => {
  const answer = event.target.closest("fieldset");
  if (answer) keep(answer);
  refresh();
});
document.addEventListener("click", (event) => {
  const button = event.target.closest("button[data-marks]");
  if (!button) return;
  const answer = button.closest("fieldset");
  marksOf(answer).value = button.dataset.marks;
  keep(answer);
  refresh();
});
filters.addEventListener("submit", (event) => event.preventDefault());
document.getElementById("save").addEventListener("click", save);

// A key is set where it is looked at: there may be thousands of entries.
const seen = new IntersectionObserver((found) => {
  for (const { target, isIntersecting } of found) {
    if (!isIntersecting) continue;
    seen.unobserve(target);
    for (const spot of target.querySelectorAll("[data-key]")) {
      spot.append(document.getElementById(spot.dataset.key).content.cloneNode(true));
    }
    for (const line of target.querySelectorAll("pre mark")) {
      line.parentElement.scrollTop = line.offsetTop - line.parentElement.clientHeight / 3;
    }
  }
}, { rootMargin: "600px" });
for (const entry of entries) seen.observe(entry);
refresh();
