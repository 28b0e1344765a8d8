import { Text } from '@codemirror/state';
import { useEffect, useState } from 'react';
import { api } from '@/api/client';
import type { PythonFinding } from '@/api/python';

const LINT_AFTER_MS = 700;

/** Findings of ruff, together with the text that they refer to. */
export interface Linted {
  readonly doc: Text;
  readonly findings: readonly PythonFinding[];
}

/** Requests findings of ruff shortly after the last change. */
export function useFindings(path: string, text: string | null): Linted | null {
  const [linted, setLinted] = useState<Linted | null>(null);
  useEffect(() => {
    if (text === null || !path.endsWith('.py')) return;
    const asking = new AbortController();
    const timer = setTimeout(() => {
      api.lintPython(text, path, asking.signal).then(
        (findings) => {
          setLinted({ doc: Text.of(text.split('\n')), findings });
        },
        // Without an answer there are no marks; the next change asks again.
        () => undefined,
      );
    }, LINT_AFTER_MS);
    return () => {
      clearTimeout(timer);
      asking.abort();
    };
  }, [path, text]);
  return linted;
}
