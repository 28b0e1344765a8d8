import { diff } from '@codemirror/merge';
import type { ChangeSpec, Text } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import type { PythonFinding, PythonPlace } from '@/api/python';
import { t } from '@/i18n';

const KEY = 'bts.formatOnSave';

export const formatsOnSave = (): boolean => localStorage.getItem(KEY) !== 'off';

export function setFormatsOnSave(on: boolean): void {
  localStorage.setItem(KEY, on ? 'on' : 'off');
}

/** Converts a place to an offset: ruff counts code points, the editor UTF-16 units. */
export function offsetOf(doc: Text, { line, column }: PythonPlace): number {
  if (line > doc.lines) return doc.length;
  const { from, text } = doc.line(Math.max(line, 1));
  const units = [...text].slice(0, Math.max(column - 1, 0)).join('').length;
  return from + units;
}

/**
 * The limits of the comparison, since the user waits for it: texts with little in common are not compared in
 * detail.
 */
const COARSE = { scanLimit: 1000, timeout: 100 };

/** Returns the changes between two texts, so that cursors and marks keep their places. */
export function changesBetween(before: string, after: string): ChangeSpec[] {
  return diff(before, after, COARSE).map(({ fromA, toA, fromB, toB }) => ({
    from: fromA,
    to: toA,
    insert: after.slice(fromB, toB),
  }));
}

function refuse(message: string): void {
  notifications.show({ color: 'yellow', title: t('code:format.failed'), message });
}

/**
 * Formats the text with ruff, as one undo step. The text stays unchanged if it has a syntax error, or has
 * changed during the request.
 */
export async function formatPython(view: EditorView, path: string, how: 'asked' | 'saving'): Promise<void> {
  const before = view.state.doc;
  try {
    const { source, findings } = await api.formatPython(before.toString(), path);
    // Saving continues without formatting; the marks in the editor show the errors.
    if (findings.length > 0 && how === 'asked') refuse(t('code:format.syntaxError'));
    if (!view.state.doc.eq(before) || source === before.toString()) return;
    view.dispatch({ changes: changesBetween(before.toString(), source), userEvent: 'format' });
  } catch (error) {
    if (how === 'saving') return;
    refuse(error instanceof ApiError ? error.message : String(error));
  }
}

export function applyFix(view: EditorView, made: Text, finding: PythonFinding): void {
  if (!finding.fix || !view.state.doc.eq(made)) return;
  const changes = finding.fix.edits.map(({ start, end, content }) => ({
    from: offsetOf(made, start),
    to: offsetOf(made, end),
    insert: content,
  }));
  view.dispatch({ changes, userEvent: 'fix' });
}
