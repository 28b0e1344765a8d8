import { change, editorFor, type Editor } from '@/features/editor3d/editing';
import { rewrite } from '@/model/document/rewrite';
import type { Edit } from '@/model/universe/edits';
import { readUniverse, type Reading } from '@/model/universe/read';
import type { Universe } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';

export const GRIDS = [0, 0.05, 0.1, 0.5] as const;

export type UniverseEditor = Editor;

const KIND = {
  pathsOf: () => [],
  keysOf: ([text = '']: readonly string[]) => readUniverse(text).universe?.things.map(({ key }) => key) ?? [],
  grid: 0.1,
};

/**
 * Returns the editor of a universe of the open project. The editor stays when the tab of the universe is
 * closed.
 */
export const editorOf = (path: string): UniverseEditor => editorFor(path, KIND);

/** Returns the current universe, as far as its text can be read. */
export const readingOf = ({ path }: UniverseEditor): Reading =>
  readUniverse(useProjectStore.getState().currentText(path) ?? '');

interface EditOptions {
  readonly mergeKey?: string;
}

/**
 * Changes the universe as one undo step, which is merged with the last one if that has the same `mergeKey`.
 */
export function edit(
  editor: UniverseEditor,
  label: string,
  make: (universe: Universe) => Edit,
  { mergeKey }: EditOptions = {},
): void {
  const { universe } = readingOf(editor);
  const text = useProjectStore.getState().currentText(editor.path);
  if (text === null || !universe) return;
  change(
    editor,
    label,
    () => {
      const { ops, select } = make(universe);
      return ops.length === 0 ? null : { texts: [rewrite(text, ops)], select };
    },
    mergeKey,
  );
}
