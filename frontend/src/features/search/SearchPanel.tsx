import { ScrollArea } from '@mantine/core';
import { useRef, type KeyboardEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { MOST_HITS } from '@/model/search/seek';
import { useProjectStore } from '@/store/project';
import { replaceHits } from '@/store/project/edits/replace';
import { undoNotification } from '@/ui/undoNotification';
import { LargeFiles } from './LargeFiles';
import { ResultGroup } from './ResultGroup';
import { replacementsOf, type Row } from './results';
import { SearchForm } from './SearchForm';
import { useSearchStore } from './searchStore';
import { useSearch, type SearchState } from './useSearch';
import classes from './search.module.css';

/** Moves the focus to the next or previous row; from elsewhere, to the first one. */
function walk(list: HTMLElement | null, step: 1 | -1): void {
  const rows = [...(list?.querySelectorAll<HTMLElement>('[data-row]') ?? [])];
  const at = rows.findIndex((row) => row === list?.ownerDocument.activeElement);
  rows[at < 0 ? 0 : at + step]?.focus();
}

/** The search panel: search in all trees and files of the project, with replacement. */
export function SearchPanel() {
  const { t } = useTranslation('search');
  const isReplacing = useSearchStore((state) => state.isReplacing);
  const isReadOnly = useProjectStore((state) => state.role === 'viewer');
  const { state, isFresh } = useSearch();
  const list = useRef<HTMLDivElement>(null);
  const results = state.kind === 'found' ? state.results : null;

  const replace = (rows: readonly Row[]): void => {
    const { count, documents, undo } = replaceHits(replacementsOf(rows));
    if (count === 0) return;
    const message = `${t('replaced', { count })} ${t('inDocuments', { count: documents })}`;
    undoNotification({ message, undoLabel: t('undo'), undo });
  };
  const onKey = (event: KeyboardEvent): void => {
    if (event.key !== 'ArrowDown' && event.key !== 'ArrowUp') return;
    event.preventDefault();
    walk(list.current, event.key === 'ArrowDown' ? 1 : -1);
  };
  const all = results?.groups.flatMap(({ rows }) => rows) ?? [];
  const canReplaceAll = !isReadOnly && isFresh && replacementsOf(all).length > 0;
  return (
    <section
      className={classes['panel']}
      aria-label={t('label')}
      data-testid="search"
      data-state={state.kind}
    >
      <SearchForm
        wrong={state.kind === 'wrong' ? t('wrong', { reason: state.reason }) : null}
        onReplaceAll={canReplaceAll ? () => replace(all) : null}
        onDown={() => walk(list.current, 1)}
      />
      <Summary state={state} />
      {state.kind === 'idle' ? null : <LargeFiles />}
      <ScrollArea className={classes['results'] ?? ''} type="auto" scrollbarSize={8}>
        {/* The rows are buttons; the arrow keys only move the focus among them. */}
        {/* eslint-disable-next-line jsx-a11y/no-static-element-interactions */}
        <div ref={list} onKeyDown={onKey}>
          {results?.groups.map((group) => (
            <ResultGroup
              key={group.path}
              group={group}
              isReplacing={isReplacing}
              isFresh={isFresh}
              onReplace={isReadOnly ? null : replace}
            />
          ))}
        </div>
      </ScrollArea>
    </section>
  );
}

/** The number of hits, or the reason why there are none. */
function Summary({ state }: { readonly state: SearchState }) {
  const { t } = useTranslation('search');
  return (
    <p className={classes['summary']} role="status">
      {summaryOf(state, t)}
    </p>
  );
}

function summaryOf(state: SearchState, t: ReturnType<typeof useTranslation<'search'>>['t']): string {
  switch (state.kind) {
    case 'idle':
      return t('idle');
    case 'searching':
      return t('searching');
    case 'too-slow':
      return t('tooSlow');
    case 'wrong':
      return '';
    case 'found': {
      const { count, groups, isCut } = state.results;
      if (count === 0) return t('nothing');
      const found = `${t('found', { count })} ${t('inDocuments', { count: groups.length })}`;
      return isCut ? `${found} ${t('cut', { count: MOST_HITS })}` : found;
    }
  }
}
