// The theme of the IDE: the same key of the browser's storage, the same attribute.
(() => {
  const KEY = "bt-studio-theme";
  const root = document.documentElement;
  const stored = () => {
    try {
      return localStorage.getItem(KEY);
    } catch {
      return null;
    }
  };
  const system = matchMedia("(prefers-color-scheme: dark)");
  const apply = () => {
    const wish = stored();
    const isDark = wish === "dark" || (wish !== "light" && system.matches);
    root.setAttribute("data-mantine-color-scheme", isDark ? "dark" : "light");
  };
  apply();
  system.addEventListener("change", apply);
  document.addEventListener("DOMContentLoaded", () => {
    document.getElementById("theme")?.addEventListener("click", () => {
      const next =
        root.getAttribute("data-mantine-color-scheme") === "dark"
          ? "light"
          : "dark";
      try {
        localStorage.setItem(KEY, next);
      } catch {
        // A browser without storage shows the theme of the system.
      }
      root.setAttribute("data-mantine-color-scheme", next);
    });
  });
})();
