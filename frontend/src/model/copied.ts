import type { Fragment } from './edits';
import { isPythonName } from './pythonNames';
import type { Sources } from './reuse';
import { parseDiagram, serializeDiagram } from './serialize';
import { fragmentToXml, xmlToFragment } from './xml';

/**
 * The text of copied blocks: their XML, which any editor accepts, and below it a comment with the trees and
 * actions that they use, as JSON. Everything from the clipboard is checked before it is used.
 */

const FORMAT = 'bt-studio/blocks';
const VERSION = 1;
const COMMENT = /\n?<!--\s*(\{"format":"bt-studio\/blocks",[^]*?\})\s*-->\s*$/;
const ACTION = /^actions\/(.+)\.py$/;
const TREE = /^trees\/([^/]+)\.json$/;

/** The limits for copying and pasting: the length of a text with its files, and the number of files. */
const MOST_CHARACTERS = 8_000_000;
const MOST_FILES = 500;
/** The limits of the server for one tree, one action and a name. */
const MOST_OF_TREE = 2_000_000;
const MOST_OF_ACTION = 2_000_000;
const MOST_OF_NAME = 200;

/** The project that blocks were copied from, and the files that they use. */
export interface Origin {
  readonly project: string;
  readonly name: string;
  readonly files: Sources;
}

/** The contents of a text from the clipboard. */
export interface Copied {
  readonly fragment: Fragment;
  /** Null for XML from elsewhere, or if the blocks use no files. */
  readonly origin: Origin | null;
  /** Whether the text has files that cannot be read; then `origin` is null. */
  readonly isDamaged: boolean;
}

/** Writes copied blocks; files that are too large for a clipboard are left out. */
export function writeCopied(fragment: Fragment, origin: Origin): string {
  const xml = fragmentToXml(fragment);
  const { project, name, files } = origin;
  const count = Object.keys(files).length;
  if (count === 0 || count > MOST_FILES) return xml;
  const json = JSON.stringify({ format: FORMAT, version: VERSION, project, name, files });
  // Two dashes would end the comment.
  const comment = `<!-- ${json.replace(/-(?=-)/g, '\\u002d')} -->\n`;
  return xml.length + comment.length > MOST_CHARACTERS ? xml : xml + comment;
}

/** Returns the text without the files in its comment, for text editors. */
export const withoutFiles = (text: string): string => text.replace(COMMENT, '');

/** Returns whether a name can be the name of a file here and on every other system. */
const isTreeName = (name: string): boolean =>
  name.length <= MOST_OF_NAME && !/[\p{Cc}\p{Cs}\\/:*?"<>|]/u.test(name) && !/^\.|^root$|[. ]$/i.test(name);

/** Returns a file that may become part of a project; null if its path, name, size or content is invalid. */
function checkedFile(path: string, text: unknown): [string, string] | null {
  if (typeof text !== 'string') return null;
  const action = ACTION.exec(path)?.[1];
  if (action !== undefined) {
    const isFine = isPythonName(action) && action.length <= MOST_OF_NAME && text.length <= MOST_OF_ACTION;
    return isFine && !text.includes('\0') ? [path, text] : null;
  }
  const tree = TREE.exec(path)?.[1];
  if (tree === undefined || !isTreeName(tree) || text.length > MOST_OF_TREE) return null;
  try {
    return [path, serializeDiagram({ ...parseDiagram(text), id: tree })];
  } catch {
    return null;
  }
}

function checkedOrigin(json: string): Origin | null {
  let document: unknown;
  try {
    document = JSON.parse(json);
  } catch {
    return null;
  }
  const { version, project, name, files } = document as Partial<Record<string, unknown>>;
  if (version !== VERSION || typeof project !== 'string' || typeof name !== 'string') return null;
  if (typeof files !== 'object' || files === null || Array.isArray(files)) return null;
  const entries = Object.entries(files);
  if (entries.length > MOST_FILES) return null;
  // Some file systems do not distinguish names that differ only in case.
  if (new Set(entries.map(([path]) => path.toLowerCase())).size < entries.length) return null;
  const checked = entries.map(([path, text]) => checkedFile(path, text));
  if (checked.some((file) => file === null)) return null;
  const texts = Object.fromEntries(checked.filter((file) => file !== null));
  return { project, name: name.slice(0, MOST_OF_NAME), files: texts };
}

/** Reads a text from the clipboard; null if it holds no blocks. */
export function readCopied(text: string): Copied | null {
  const fragment = xmlToFragment(withoutFiles(text));
  if (!fragment) return null;
  const json = COMMENT.exec(text)?.[1];
  const origin = json === undefined || text.length > MOST_CHARACTERS ? null : checkedOrigin(json);
  return { fragment, origin, isDamaged: json !== undefined && origin === null };
}
