import { registerCommands } from '@/commands/registry';
import { ActionIcon, Tooltip, useComputedColorScheme, useMantineColorScheme } from '@mantine/core';
import { IconMoon, IconSun } from '@tabler/icons-react';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';
import { useIsBasic } from '@/store/viewMode';
import { usePressed } from './hooks/usePressed';

export function ThemeToggle() {
  const { t } = useTranslation('frame');
  const { setColorScheme } = useMantineColorScheme();
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const labelKey = isDark ? 'theme.toLight' : 'theme.toDark';
  const label = t(labelKey);
  const { isPressed, handlers } = usePressed();
  const toggle = () => setColorScheme(isDark ? 'light' : 'dark');
  useEffect(
    () =>
      registerCommands([
        {
          id: 'view.theme',
          group: 'view',
          labelKey: `frame:${labelKey}`,
          icon: isDark ? IconSun : IconMoon,
          run: () => setColorScheme(isDark ? 'light' : 'dark'),
        },
      ]),
    [labelKey, isDark, setColorScheme],
  );
  const isBasic = useIsBasic(); // then it is in the menu
  if (isBasic) return null;
  return (
    <Tooltip label={label} disabled={isPressed}>
      <ActionIcon size="lg" aria-label={label} data-testid="theme-toggle" onClick={toggle} {...handlers}>
        {isDark ? <IconSun size={20} /> : <IconMoon size={20} />}
      </ActionIcon>
    </Tooltip>
  );
}
