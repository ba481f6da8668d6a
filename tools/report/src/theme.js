// Dark or light theme: the system's choice until the user makes another. Paper is light.

const system = matchMedia("(prefers-color-scheme: dark)");

export function makeTheme(button, onChange) {
  const root = document.documentElement;
  let chosen = null;
  let isPrinting = false;
  const isDark = () => !isPrinting && (chosen ?? (system.matches ? "dark" : "light")) === "dark";
  const apply = () => {
    root.dataset.theme = isDark() ? "dark" : "light";
    button.textContent = isDark() ? "Light theme" : "Dark theme";
    onChange();
  };
  button.addEventListener("click", () => {
    chosen = isDark() ? "light" : "dark";
    apply();
  });
  system.addEventListener("change", apply);
  for (const name of ["beforeprint", "afterprint"]) {
    addEventListener(name, () => {
      isPrinting = name === "beforeprint";
      apply();
    });
  }
  apply();
}

/** The value of a CSS variable of the current theme. */
export const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
