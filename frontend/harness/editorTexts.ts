import i18next from 'i18next';
import { readdirSync, readFileSync } from 'node:fs';
import '@/i18n';

/*
 * The texts of an open project, as `src/i18n/editorTexts` adds them. They are read once for all files of tests in
 * a process: as modules, eighty of them would be evaluated for each file.
 */
const KEY = Symbol.for('bt-studio/editor-texts');
const LOCALES = `${import.meta.dirname}/../src/i18n/locales`;

type Texts = readonly (readonly [language: string, feature: string, texts: object])[];

function read(): Texts {
  const texts = readdirSync(LOCALES).flatMap((language) =>
    readdirSync(`${LOCALES}/${language}`).map((name) => {
      const text = readFileSync(`${LOCALES}/${language}/${name}`, 'utf8');
      return [language, name.replace('.json', ''), JSON.parse(text) as object] as const;
    }),
  );
  Reflect.set(globalThis, KEY, texts);
  return texts;
}

for (const [language, feature, texts] of (Reflect.get(globalThis, KEY) as Texts | undefined) ?? read())
  i18next.addResourceBundle(language, feature, texts, false, true, { silent: true, skipCopy: true });
