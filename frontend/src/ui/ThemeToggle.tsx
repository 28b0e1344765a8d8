import { registerCommands } from '@/commands/registry';
import { ActionIcon, Tooltip, useComputedColorScheme, useMantineColorScheme } from '@mantine/core';
import { IconMoon, IconSun } from '@tabler/icons-react';
import { useEffect } from 'react';
import { useTranslation } from 'react-i18next';

export function ThemeToggle() {
  const { t } = useTranslation('frame');
  const { setColorScheme } = useMantineColorScheme();
  const isDark = useComputedColorScheme('light', { getInitialValueInEffect: false }) === 'dark';
  const labelKey = isDark ? 'theme.toLight' : 'theme.toDark';
  const label = t(labelKey);
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
  return (
    <Tooltip label={label}>
      <ActionIcon size="lg" aria-label={label} data-testid="theme-toggle" onClick={toggle}>
        {isDark ? <IconSun size={20} /> : <IconMoon size={20} />}
      </ActionIcon>
    </Tooltip>
  );
}
