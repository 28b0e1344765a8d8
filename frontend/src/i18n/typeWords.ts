import { namesOf } from '@/model/values';
import { t } from '.';

const KNOWN = ['int', 'uint', 'int64', 'double', 'bool', 'status', 'string', 'script', 'any'] as const;

/** Returns what a port of a type takes, in words: `a whole number`, like `translator/values.py`. */
export function typeWords(type: string): string {
  const known = KNOWN.find((each) => each === type);
  if (known) return t(`editor:types.${known}`);
  const names = namesOf(type);
  if (names) return t('editor:types.oneOf', { names: names.join(', ') });
  if (type.startsWith('list[')) return t('editor:types.list', { each: typeWords(type.slice(5, -1)) });
  return type.includes('/') ? t('editor:types.interface', { name: type }) : type;
}

const SHORT = ['int', 'uint', 'int64', 'double', 'bool', 'status', 'string', 'script'] as const;

/** Returns the name of a type beside a port: `whole number`; that of an enumeration or a class as it is. */
export function typeName(type: string): string {
  const short = SHORT.find((each) => each === type);
  if (short) return t(`inspector:types.${short}`);
  if (type.startsWith('list[')) return t('inspector:types.list');
  return namesOf(type) === null ? type : (type.split('[')[0] ?? type);
}
