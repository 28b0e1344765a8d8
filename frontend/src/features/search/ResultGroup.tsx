import { ActionIcon, Tooltip } from '@mantine/core';
import {
  IconChevronDown,
  IconChevronRight,
  IconFileCode,
  IconFileText,
  IconGitFork,
  IconReplace,
} from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { treeIdOf } from '@/store/project/state';
import { ResultRow } from './ResultRow';
import type { Group, Row } from './results';
import classes from './search.module.css';

interface ResultGroupProps {
  readonly group: Group;
  readonly isReplacing: boolean;
  /** Whether the replacements are those of the current search; before that, nothing can be replaced. */
  readonly isFresh: boolean;
  /** null if the project is read-only. */
  readonly onReplace: ((rows: readonly Row[]) => void) | null;
}

function DocumentIcon({ path }: { readonly path: string }) {
  if (treeIdOf(path) !== null) return <IconGitFork size={15} aria-hidden="true" />;
  return path.endsWith('.py') ? (
    <IconFileCode size={15} aria-hidden="true" />
  ) : (
    <IconFileText size={15} aria-hidden="true" />
  );
}

/** The hits in one tree or file; the heading folds them. */
export function ResultGroup({ group: { path, rows }, isReplacing, isFresh, onReplace }: ResultGroupProps) {
  const { t } = useTranslation('search');
  const [isFolded, setFolded] = useState(false);
  const name = treeIdOf(path) ?? path;
  return (
    <section className={classes['group']} data-testid={`search-in-${path}`}>
      <h2 className={classes['heading']}>
        <button
          type="button"
          className={classes['title']}
          aria-expanded={!isFolded}
          title={path}
          onClick={() => setFolded(!isFolded)}
        >
          {isFolded ? <IconChevronRight size={14} /> : <IconChevronDown size={14} />}
          <DocumentIcon path={path} />
          <span className={classes['path']}>{name}</span>
          <span className={classes['count']}>{rows.length}</span>
        </button>
        {isReplacing && onReplace ? (
          <Tooltip label={t('replaceIn', { name })}>
            <ActionIcon
              size={24}
              disabled={!isFresh}
              aria-label={t('replaceIn', { name })}
              onClick={() => onReplace(rows)}
            >
              <IconReplace size={14} />
            </ActionIcon>
          </Tooltip>
        ) : null}
      </h2>
      {isFolded ? null : (
        <ul className={classes['list']}>
          {rows.map((row) => (
            <ResultRow
              key={`${JSON.stringify(row.passage.place)} ${row.hit.start}`}
              row={row}
              isReplacing={isReplacing}
              isFresh={isFresh}
              onReplace={onReplace && (() => onReplace([row]))}
            />
          ))}
        </ul>
      )}
    </section>
  );
}
