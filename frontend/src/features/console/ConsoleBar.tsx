import { ActionIcon, NativeSelect, TextInput, Tooltip } from '@mantine/core';
import { IconArrowDown, IconEraser, IconSearch } from '@tabler/icons-react';
import { memo } from 'react';
import { useTranslation } from 'react-i18next';
import type { LogLevel } from '@/generated/messages';
import { useSessionStore } from '@/store/session/store';
import { useIsBasic } from '@/store/viewMode';
import classes from './console.module.css';
import { LEVELS, useConsoleFilter, type ConsoleFilter } from './filter';

interface ConsoleBarProps {
  readonly sources: readonly { readonly value: string; readonly label: string }[];
  /** Follows the end again; null while the view does. */
  readonly toEnd: (() => void) | null;
  readonly mayClear: boolean;
}

/** Search and filters of the console. It is not rendered with the lines, which change with each moment. */
export const ConsoleBar = memo(function ConsoleBar({ sources, toEnd, mayClear }: ConsoleBarProps) {
  const { t } = useTranslation('console');
  const filter = useConsoleFilter();
  // A filter that hides lines is always shown.
  const isBasic = useIsBasic() && filter.source === 'all' && filter.level === 'info';
  return (
    <div className={classes['bar']}>
      <TextInput
        size="xs"
        type="search"
        className={classes['search']}
        value={filter.search}
        placeholder={t('search')}
        aria-label={t('search')}
        leftSection={<IconSearch size={14} />}
        onChange={(event) => useConsoleFilter.setState({ search: event.currentTarget.value })}
      />
      {isBasic ? null : (
        <>
          <NativeSelect
            size="xs"
            value={filter.source}
            aria-label={t('source')}
            data={sources}
            onChange={(event) =>
              useConsoleFilter.setState({ source: event.currentTarget.value as ConsoleFilter['source'] })
            }
          />
          <NativeSelect
            size="xs"
            value={filter.level}
            aria-label={t('level')}
            data={LEVELS.map((value) => ({ value, label: t(`levels.${value}`) }))}
            onChange={(event) => useConsoleFilter.setState({ level: event.currentTarget.value as LogLevel })}
          />
        </>
      )}
      <span className={classes['spacer']} />
      {toEnd ? (
        <Tooltip label={t('toEnd')}>
          <ActionIcon aria-label={t('toEnd')} onClick={toEnd}>
            <IconArrowDown size={16} />
          </ActionIcon>
        </Tooltip>
      ) : null}
      {isBasic ? null : (
        <Tooltip label={t('clear')}>
          <ActionIcon
            aria-label={t('clear')}
            disabled={!mayClear}
            onClick={() => useSessionStore.setState({ logs: [] })}
          >
            <IconEraser size={16} />
          </ActionIcon>
        </Tooltip>
      )}
    </div>
  );
});
