import { Button, SegmentedControl, Text } from '@mantine/core';
import { useRef, useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { Revision } from '@/api/revisions';
import { useTabs } from '@/workspace/tabs';
import { openTab } from '@/workspace/tabs';
import { treePath } from '@/store/project/state';
import { useShowMore } from '@/ui/hooks/useShowMore';
import { useVisible } from '@/ui/hooks/useVisible';
import { ShowMore } from '@/ui/ShowMore';
import { useComparison } from './compare';
import { groupRevisions, type RevisionGroup } from './groups';
import classes from './revisions.module.css';
import { RevisionRow } from './RevisionRow';
import { setScope, useScope } from '@/store/revisions/scope';
import { useRevisions } from './useRevisions';

/** The panel with the revisions of the document in front, or of the project. */
export function RevisionsPanel() {
  const { t } = useTranslation('revisions');
  const panel = useRef<HTMLDivElement>(null);
  const isVisible = useVisible(panel);
  const scope = useScope((state) => state.scope);
  const front = useTabs((state) => state.front);
  const file = front?.kind === 'tree' ? treePath(front.id) : front?.kind === 'file' ? front.path : null;
  const path = scope === 'file' && file !== null ? file : '';
  const history = useRevisions(path, isVisible);
  const { showMore, isLoadingMore } = useShowMore(history, path);
  const groups = groupRevisions(history.items);
  const isAlone = new Set(history.items.map((item) => item.author)).size <= 1;
  const name =
    file
      ?.split('/')
      .at(-1)
      ?.replace(/\.json$/, '') ?? t('scope.file');
  return (
    <div ref={panel} className={classes['panel']} data-testid="history">
      <div className={classes['scope']}>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label={t('scope.label')}
          value={path ? 'file' : 'project'}
          onChange={(value) => setScope(value === 'project' ? 'project' : 'file')}
          data={[
            { value: 'file', label: name, disabled: file === null },
            { value: 'project', label: t('scope.project') },
          ]}
        />
      </div>
      {history.error ? (
        <div className={classes['empty']} role="alert">
          <Text size="sm">{t('failed', { reason: history.error.message })}</Text>
          <Button size="compact-sm" variant="light" onClick={() => void history.refetch()}>
            {t('retry')}
          </Button>
        </div>
      ) : null}
      {history.isSuccess && groups.length === 0 ? (
        <Text size="sm" c="dimmed" className={classes['empty']}>
          {t('none')}
        </Text>
      ) : null}
      <ol className={classes['list']} aria-label={t('list')}>
        {groups.map((group) => (
          <Group key={group.newest.number} group={group} path={path} isAlone={isAlone} />
        ))}
        {history.hasNextPage ? (
          <li className={classes['more']}>
            <ShowMore size="compact-sm" variant="light" isLoading={isLoadingMore} onClick={showMore}>
              {t('more')}
            </ShowMore>
          </li>
        ) : null}
      </ol>
    </div>
  );
}

interface GroupProps {
  readonly group: RevisionGroup;
  readonly path: string;
  readonly isAlone: boolean;
}

function Group({ group: { newest, saves }, path, isAlone }: GroupProps) {
  const [isUnfolded, setUnfolded] = useState(false);
  const chosen = useComparison(({ comparison }) => comparison?.revision.number);
  const choose = (revision: Revision, oldest: Revision) => {
    const against = useComparison.getState().comparison?.against === 'now' ? 'now' : 'before';
    const before = oldest.number - 1;
    useComparison.setState({ comparison: { revision, before, against, path: path || null } });
    openTab({ kind: 'compare' });
  };
  const oldest = saves.at(-1) ?? newest;
  return (
    <li>
      <RevisionRow
        revision={newest}
        count={saves.length}
        isChosen={chosen === newest.number}
        isUnfolded={isUnfolded}
        isAlone={isAlone}
        onChoose={() => choose(newest, oldest)}
        onUnfold={() => setUnfolded(!isUnfolded)}
      />
      {isUnfolded ? (
        <ol className={classes['saves']}>
          {saves.slice(1).map((save) => (
            <li key={save.number}>
              <RevisionRow
                revision={save}
                count={1}
                isInner
                isChosen={chosen === save.number}
                isAlone={isAlone}
                onChoose={() => choose(save, save)}
              />
            </li>
          ))}
        </ol>
      ) : null}
    </li>
  );
}
