import { api } from '@/api/client';
import { useProjectStore } from '@/store/project';
import { clearTextFindings, setTextFindings, useTextFindings } from './texts';

const LINT_AFTER_MS = 700;

const timers = new Map<string, ReturnType<typeof setTimeout>>();
const requests = new Map<string, AbortController>();

function cancel(path: string): void {
  clearTimeout(timers.get(path));
  timers.delete(path);
  requests.get(path)?.abort();
  requests.delete(path);
}

async function lint(path: string): Promise<void> {
  const text = useProjectStore.getState().currentText(path);
  if (text === null || useTextFindings.getState().linted[path]?.text === text) return;
  const request = new AbortController();
  requests.set(path, request);
  try {
    const findings = await api.lintPython(text, path, request.signal);
    if (!request.signal.aborted) setTextFindings('linted', path, { text, findings });
  } catch {
    // Without an answer the earlier findings stay; the next change requests them again.
  } finally {
    if (requests.get(path) === request) requests.delete(path);
  }
}

/** Requests ruff's findings in a Python file, shortly after the last call for that file. */
export function lintSoon(path: string): void {
  if (!path.endsWith('.py')) return;
  cancel(path);
  timers.set(
    path,
    setTimeout(() => {
      timers.delete(path);
      void lint(path);
    }, LINT_AFTER_MS),
  );
}

function forget(path: string): void {
  cancel(path);
  setTextFindings('linted', path, null);
}

/**
 * Requests findings whenever a Python file of the open project changes; returns a function that stops this.
 */
export function watchPython(): () => void {
  const unwatch = useProjectStore.subscribe((now, before) => {
    if (now.files === before.files) return;
    for (const path of Object.keys(before.files)) if (!(path in now.files)) forget(path);
    for (const [path, entry] of Object.entries(now.files)) {
      if (entry.text !== before.files[path]?.text) lintSoon(path);
    }
  });
  return () => {
    unwatch();
    for (const path of [...timers.keys(), ...requests.keys()]) cancel(path);
    clearTextFindings();
  };
}
