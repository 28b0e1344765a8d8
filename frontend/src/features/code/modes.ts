import { json } from '@codemirror/lang-json';
import { python } from '@codemirror/lang-python';
import { xml } from '@codemirror/lang-xml';
import { yaml } from '@codemirror/lang-yaml';
import { markdown } from '@codemirror/lang-markdown';
import { indentUnit } from '@codemirror/language';
import type { Extension } from '@codemirror/state';

export const isXml = (path: string): boolean => /\.(xml|urdf|sdf|launch)$/.test(path);

/** Returns the syntax colouring and indentation for a file, by its name. */
export function languageOf(path: string): Extension {
  if (path.endsWith('.py')) return [python(), indentUnit.of('    ')];
  if (path.endsWith('.json')) return [json(), indentUnit.of('  ')];
  if (isXml(path)) return [xml(), indentUnit.of('  ')];
  if (/\.ya?ml$/.test(path)) return [yaml(), indentUnit.of('  ')];
  if (/\.(md|markdown)$/.test(path)) return [markdown(), indentUnit.of('  ')];
  return indentUnit.of('  ');
}
