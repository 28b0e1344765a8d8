import { Button, Center, SegmentedControl, Select, Text } from '@mantine/core';
import { IconArrowsDiff, IconPencil } from '@tabler/icons-react';
import { useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { ReadOnlyCanvas } from '@/features/canvas/ReadOnlyCanvas';
import type { NodeId } from '@/model/diagram';
import type { ChangeKind } from '@/model/difference/changes';
import { lookNow } from '@/store/moment/looking';
import { openPastTree, selectPast, shownTree, usePastTree, type PastView } from '@/store/moment/pastTree';
import { FOREIGN_TREE, type RecordedTree } from '@/store/moment/recordedTrees';
import { useMoment } from '@/store/moment/store';
import { useProjectStore } from '@/store/project';
import { openTree } from '@/store/project/navigation';
import { Details } from './Details';
import { NodeList } from './NodeList';
import classes from './recorded.module.css';
import { Since } from './Since';
import { SourceView } from './source/SourceView';
import { useSince } from './useSince';
import { withRecorded } from './vocabulary';

/** Beyond this number of blocks only the list is offered. */
const MOST_BLOCKS = 2000;
const NO_MARKS: ReadonlyMap<NodeId, ChangeKind> = new Map();

/** The tab with the tree as it ran at the moment at which the user looks. It is read-only. */
export function PastTab() {
  const { t } = useTranslation('axis');
  const isShown = useMoment((state) => state.shown !== null);
  const trees = useMoment((state) => state.trees);
  const active = useProjectStore((state) => state.activeTree);
  const wanted = usePastTree((state) => state.tree);
  const ids = useMemo(() => Object.keys(trees), [trees]);
  const id = shownTree(wanted, ids, active);
  const recorded = id === null ? undefined : trees[id];
  if (isShown && recorded) return <PastTree recorded={recorded} ids={ids} />;
  return (
    <Center h="100%" p="md">
      <Text c="dimmed">{t(isShown ? 'past.none' : 'past.present')}</Text>
    </Center>
  );
}

interface PastTreeProps {
  readonly recorded: RecordedTree;
  readonly ids: readonly string[];
}

function PastTree({ recorded, ids }: PastTreeProps) {
  const { t } = useTranslation('axis');
  const { diagram } = recorded;
  const since = useSince(recorded, ids);
  const nodes = useMoment((state) => state.tree);
  const present = useProjectStore((state) => state.vocabulary);
  const vocabulary = useMemo(() => withRecorded(present, nodes), [present, nodes]);
  const selected = usePastTree((state) => state.node);
  const wanted = usePastTree((state) => state.view);
  const size = Object.keys(diagram.nodes).length;
  const view = size > MOST_BLOCKS && wanted === 'canvas' ? 'list' : wanted;
  const uid = nodes.find((node) => node.tree_id === diagram.id && node.node_id === selected)?.uid ?? null;
  const openBlock = (block: NodeId) => {
    const tree = diagram.nodes[block]?.tree;
    if (tree !== undefined && ids.includes(tree)) openPastTree(tree);
  };
  return (
    <section className={classes['tab']} aria-label={t('past.label')} data-testid="past-tab">
      <header className={classes['head']}>
        <Moment />
        {ids.length > 1 ? (
          <Select
            size="xs"
            w={170}
            allowDeselect={false}
            aria-label={t('past.tree')}
            data={ids}
            value={diagram.id}
            onChange={(tree) => tree !== null && openPastTree(tree)}
          />
        ) : null}
        <SegmentedControl
          size="xs"
          aria-label={t('past.view.label')}
          value={view}
          onChange={(value) => usePastTree.setState({ view: value as PastView })}
          data={[
            { value: 'canvas', label: t('past.view.canvas'), disabled: size > MOST_BLOCKS },
            { value: 'list', label: t('past.view.list') },
            { value: 'source', label: t('past.view.source') },
          ]}
        />
        <CompareButton tree={diagram.id} />
        <EditButton tree={diagram.id} />
      </header>
      <div className={classes['body']}>
        {view === 'list' ? (
          <NodeList tree={nodes} />
        ) : view === 'source' ? (
          <SourceView uid={uid} />
        ) : (
          <ReadOnlyCanvas
            diagram={diagram}
            vocabulary={vocabulary}
            label={t('past.canvas', { tree: diagram.id })}
            selected={selected !== null && selected in diagram.nodes ? selected : null}
            onSelect={(block) => selectPast(diagram.id, block)}
            onOpen={openBlock}
            marks={since?.marks ?? NO_MARKS}
          />
        )}
      </div>
      {since ? <Since since={since} /> : null}
      {selected !== null && selected in diagram.nodes ? <Details diagram={diagram} id={selected} /> : null}
    </section>
  );
}

/** Says that the tab is of the past; it is drawn alone, since the moment changes often. */
function Moment() {
  const { t } = useTranslation('axis');
  const at = useMoment((state) => state.shown?.t.toFixed(2) ?? '');
  return (
    <span className={classes['moment']} title={t('past.help')}>
      {t('past.at', { t: at })}
    </span>
  );
}

/** Returns to the present, in which the tree can be edited. */
function EditButton({ tree }: { readonly tree: string }) {
  const { t } = useTranslation('axis');
  const exists = useProjectStore((state) => tree in state.diagrams);
  if (tree === FOREIGN_TREE) return null;
  const edit = () => {
    lookNow();
    if (exists) openTree(tree);
  };
  return (
    <Button
      size="compact-xs"
      variant="default"
      leftSection={<IconPencil size={14} />}
      title={t('past.editHelp')}
      onClick={edit}
    >
      {t('past.edit')}
    </Button>
  );
}

/** Marks what changed in the project since the run. */
function CompareButton({ tree }: { readonly tree: string }) {
  const { t } = useTranslation('axis');
  const isCompared = usePastTree((state) => state.isCompared);
  if (tree === FOREIGN_TREE) return null;
  return (
    <Button
      size="compact-xs"
      variant={isCompared ? 'filled' : 'default'}
      leftSection={<IconArrowsDiff size={14} />}
      aria-pressed={isCompared}
      onClick={() => usePastTree.setState({ isCompared: !isCompared })}
    >
      {t('past.compare')}
    </Button>
  );
}
