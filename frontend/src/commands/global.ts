import { IconCommand, IconLanguage } from '@tabler/icons-react';
import { LANGUAGES, setLanguage, type Language } from '@/i18n';
import { togglePalette } from './palette';
import type { UserCommand } from './registry';

const palette: UserCommand = {
  id: 'frame.palette',
  group: 'view',
  labelKey: 'frame:command.commandPalette',
  icon: IconCommand,
  shortcut: '$mod+KeyK',
  inTextFields: true,
  hidden: true,
  run: togglePalette,
};

const languages = (Object.keys(LANGUAGES) as Language[]).map((code): UserCommand => ({
  id: `view.language.${code}`,
  group: 'view',
  labelKey: `frame:languages.${code}`,
  icon: IconLanguage,
  run: () => setLanguage(code),
}));

/** The commands that exist both on the start page and in an open project. */
export const everywhere: readonly UserCommand[] = [palette, ...languages];
