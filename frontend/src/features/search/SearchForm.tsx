import { ActionIcon, TextInput, Tooltip } from '@mantine/core';
import { IconChevronDown, IconChevronRight, IconReplace, IconSearch } from '@tabler/icons-react';
import { useEffect, useRef, type KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { perform } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { setSearch, useSearchStore } from './searchStore';
import classes from './search.module.css';

const TOGGLES = [
  ['matchesCase', 'Aa'],
  ['isWholeWord', '“ab”'],
  ['isRegex', '.*'],
] as const;

interface SearchFormProps {
  readonly wrong: string | null;
  /** null if there is nothing to replace. */
  readonly onReplaceAll: (() => void) | null;
  readonly onDown: () => void;
}

/** The form of the search: text, options, and replacement. */
export function SearchForm({ wrong, onReplaceAll, onDown }: SearchFormProps) {
  const { t } = useTranslation('search');
  const { text, replacement, isReplacing, asked, ...query } = useSearchStore();
  const isReadOnly = useProjectStore((state) => state.role === 'viewer');
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => {
    if (asked === 0) return;
    field.current?.focus();
    field.current?.select();
  }, [asked]);

  const onKey = (event: KeyboardEvent): void => {
    if (event.key === 'Escape') perform('go.tree');
    if (event.key === 'ArrowDown' || event.key === 'Enter') {
      event.preventDefault();
      onDown();
    }
  };
  return (
    <div className={classes['form']} role="search" aria-label={t('label')}>
      <ActionIcon
        size={28}
        className={classes['unfold'] ?? ''}
        aria-label={t('replaceRow')}
        aria-expanded={isReplacing}
        onClick={() => setSearch({ isReplacing: !isReplacing })}
      >
        {isReplacing ? <IconChevronDown size={16} /> : <IconChevronRight size={16} />}
      </ActionIcon>
      <div className={classes['fields']}>
        <TextInput
          ref={field}
          size="xs"
          type="search"
          data-testid="search-text"
          aria-label={t('text')}
          placeholder={t('text')}
          leftSection={<IconSearch size={14} aria-hidden="true" />}
          value={text}
          error={wrong}
          onChange={({ currentTarget }) => setSearch({ text: currentTarget.value })}
          onKeyDown={onKey}
        />
        <div className={classes['toggles']} role="group" aria-label={t('how')}>
          {TOGGLES.map(([name, face]) => (
            <Tooltip key={name} label={t(name)}>
              <button
                type="button"
                className={classes['toggle']}
                aria-label={t(name)}
                aria-pressed={query[name]}
                onClick={() => setSearch({ [name]: !query[name] })}
                data-face={face}
              />
            </Tooltip>
          ))}
        </div>
        {isReplacing ? (
          <div className={classes['replace']}>
            <TextInput
              size="xs"
              data-testid="search-replacement"
              aria-label={t('replacement')}
              placeholder={t('replacement')}
              leftSection={<IconReplace size={14} aria-hidden="true" />}
              value={replacement}
              disabled={isReadOnly}
              description={isReadOnly ? t('readOnly') : undefined}
              onChange={({ currentTarget }) => setSearch({ replacement: currentTarget.value })}
              onKeyDown={onKey}
            />
            <Tooltip label={t('replaceAll')}>
              <ActionIcon
                size={28}
                variant="light"
                color="indigo"
                aria-label={t('replaceAll')}
                data-testid="replace-all"
                disabled={onReplaceAll === null}
                onClick={() => onReplaceAll?.()}
              >
                <IconReplace size={16} />
              </ActionIcon>
            </Tooltip>
          </div>
        ) : null}
      </div>
    </div>
  );
}
