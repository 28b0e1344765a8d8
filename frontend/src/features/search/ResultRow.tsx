import { ActionIcon, Tooltip } from '@mantine/core';
import { IconLock, IconReplace } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { displayName } from '@/model/diagram';
import { excerptOf, shortened } from '@/model/search/excerpt';
import { canReplace, type Passage } from '@/model/search/passages';
import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import { treeIdOf } from '@/store/project/state';
import type { Row } from './results';
import classes from './search.module.css';

interface ResultRowProps {
  readonly row: Row;
  readonly isReplacing: boolean;
  /** Whether the replacements are those of the current search; before that, nothing can be replaced. */
  readonly isFresh: boolean;
  /** null if the project is read-only. */
  readonly onReplace: (() => void) | null;
}

/** Opens the block or line of a hit. */
function go({ path, place }: Passage, line: number): void {
  const tree = treeIdOf(path);
  if (!place || tree === null) return openFile(path, line);
  openTree(tree);
  useProjectStore.getState().reveal(tree, place.node);
}

/** The row of a hit: its line, and the line after the replacement. */
export function ResultRow({ row: { passage, hit }, isReplacing, isFresh, onReplace }: ResultRowProps) {
  const { t } = useTranslation('search');
  const { before, hit: found, after, line } = excerptOf(passage.text, hit.start, hit.end);
  const isFixed = !canReplace(passage);
  return (
    <li className={classes['item']}>
      <button
        type="button"
        className={classes['row']}
        data-row=""
        data-path={passage.path}
        onClick={() => go(passage, line)}
      >
        <span className={classes['excerpt']}>
          {before}
          {isReplacing && isFresh && !isFixed ? (
            <>
              <del>{found}</del>
              <ins>{shortened(hit.replacement)}</ins>
            </>
          ) : (
            <mark>{found}</mark>
          )}
          {after}
        </span>
        <span className={classes['where']}>
          {passage.place ? <BlockPlace passage={passage} /> : t('line', { line })}
        </span>
      </button>
      {isReplacing && isFixed ? (
        <Tooltip label={t('fixed')} multiline maw={260}>
          <span className={classes['lock']} role="img" aria-label={t('fixed')}>
            <IconLock size={14} />
          </span>
        </Tooltip>
      ) : null}
      {isReplacing && !isFixed && onReplace ? (
        <Tooltip label={t('replaceOne')}>
          <ActionIcon size={24} disabled={!isFresh} aria-label={t('replaceOne')} onClick={onReplace}>
            <IconReplace size={14} />
          </ActionIcon>
        </Tooltip>
      ) : null}
    </li>
  );
}

/** The block of a hit, and the field in the block. */
function BlockPlace({ passage: { path, place } }: { readonly passage: Passage }) {
  const { t } = useTranslation('search');
  const node = useProjectStore(({ diagrams }) => place && diagrams[treeIdOf(path) ?? '']?.nodes[place.node]);
  if (!place) return null;
  const { field } = place;
  const name = 'name' in field ? field.name : '';
  return (
    <>
      {node ? `${displayName(node)} · ` : ''}
      {t(`field.${field.part}`, { name })}
    </>
  );
}
