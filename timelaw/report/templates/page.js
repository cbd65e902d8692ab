(() => {
  "use strict";
  const value = (row, column) => {
    const text = row.cells[column].textContent.trim();
    const number = parseFloat(text.replace(/−/g, "-").replace("∞", "Infinity"));
    return { text, number: text === "∞" ? Infinity : number };
  };
  const compare = (a, b) => {
    if (!Number.isNaN(a.number) && !Number.isNaN(b.number) && a.number !== b.number) return a.number - b.number;
    return a.text.localeCompare(b.text, "en", { numeric: true });
  };
  const sort = (table, heads, column) => {
    const head = heads[column];
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((one) => one.setAttribute("aria-sort", "none"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const rows = [...table.tBodies[0].rows];
    const keyed = rows.map((row) => ({ row, key: value(row, column) }));
    keyed.sort((a, b) => (down ? -1 : 1) * compare(a.key, b.key));
    table.tBodies[0].append(...keyed.map((one) => one.row));
  };
  const copy = async (table, button) => {
    const cells = (row) => [...row.cells].map((cell) => cell.innerText.replace(/\s+/g, " ").trim()).join("\t");
    const text = [...table.rows].map(cells).join("\n");
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "copied";
    } catch {
      const range = document.createRange();
      range.selectNode(table);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      button.textContent = "selected: press Ctrl+C";
    }
    setTimeout(() => { button.textContent = "copy table"; }, 2500);
  };
  document.querySelectorAll(".table").forEach((frame) => {
    const table = frame.querySelector("table");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "copy table";
    button.addEventListener("click", () => copy(table, button));
    frame.prepend(button);
    if (table.dataset.sort === "no" || table.tBodies[0].rows.length < 3) return;
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      head.setAttribute("aria-sort", "none");
      head.tabIndex = 0;
      head.title = "sort by this column";
      head.addEventListener("click", () => sort(table, heads, column));
      head.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        sort(table, heads, column);
      });
    });
  });
  const folded = [];
  addEventListener("beforeprint", () => {
    document.querySelectorAll("details:not([open])").forEach((one) => { folded.push(one); one.open = true; });
  });
  addEventListener("afterprint", () => { folded.splice(0).forEach((one) => { one.open = false; }); });
})();
