import { useProjectStore } from '.';
import { documentName, kindOf } from './moving';

/** Returns the text of a copy: a tree's text contains its id, an action's text its class. */
function renamedIn(path: string, text: string, name: string): string {
  const kind = kindOf(path);
  if (kind === 'tree') return JSON.stringify({ ...(JSON.parse(text) as object), id: name }, null, 2);
  if (kind !== 'action') return text;
  return text.replace(new RegExp(`^class ${documentName(path)}\\b`, 'm'), `class ${name}`);
}

/** Returns the path of a copy: beside the document, with a free name. */
function copyPath(path: string, taken: ReadonlySet<string>): string {
  const [, stem = path, suffix = ''] = /^(.*?)(\.[^./]+)?$/.exec(path) ?? [];
  for (let number = 1; ; number += 1) {
    const copy = `${stem}_copy${number === 1 ? '' : number}${suffix}`;
    if (!taken.has(copy.toLowerCase())) return copy;
  }
}

/** Returns whether a document can be duplicated: it must be one file of text. A large one is loaded before. */
export function canDuplicate(path: string): boolean {
  const { currentText, files } = useProjectStore.getState();
  return kindOf(path) !== 'robot' && (currentText(path) !== null || files[path]?.kind === 'large');
}

/** Adds a copy of a document; returns its path, or null if it cannot be copied. */
export function duplicateDocument(path: string): string | null {
  const { files, currentText, addFile } = useProjectStore.getState();
  const text = currentText(path);
  if (text === null || !canDuplicate(path)) return null;
  const copy = copyPath(path, new Set(Object.keys(files).map((each) => each.toLowerCase())));
  addFile(copy, renamedIn(path, text, documentName(copy)));
  return copy;
}
