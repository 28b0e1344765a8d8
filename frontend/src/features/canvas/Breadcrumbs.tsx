import { IconChevronRight } from '@tabler/icons-react';
import { Fragment, memo, useMemo } from 'react';
import { useTranslation } from 'react-i18next';
import { displayName, parentOf, type Diagram, type NodeId } from '@/model/diagram';
import { treeFacts } from '@/model/treeFacts';
import { openTree } from '@/store/project/navigation';
import { useProjectStore } from '@/store/project';
import { useIsBasic } from '@/store/viewMode';
import classes from './Canvas.module.css';

function pathTo(diagram: Diagram | undefined, id: NodeId | undefined): NodeId[] {
  const path: NodeId[] = [];
  for (let at: NodeId | null = id ?? null; diagram && at !== null; at = parentOf(diagram, at))
    path.unshift(at);
  return path;
}

function nameOf(diagram: Diagram | undefined, id: NodeId): string {
  const node = diagram?.nodes[id];
  return node ? displayName(node) : id;
}

/** Returns the trees above this one, up to the main tree. */
function ownersOf(diagrams: Readonly<Record<string, Diagram>>, treeId: string, main: string): string[] {
  const owners: string[] = [];
  let tree = treeId;
  while (tree !== main) {
    const user = Object.values(diagrams).find((each) => treeFacts(each).calls.has(tree));
    if (!user || owners.includes(user.id) || user.id === treeId) break;
    owners.unshift(user.id);
    tree = user.id;
  }
  return owners;
}

/** The largest number of blocks in the path: the first block, and the last ones. */
const NEAREST = 4;

interface PartOfPath {
  readonly id: NodeId;
  /** The blocks of the path that are left out before this one. */
  readonly passed: readonly NodeId[];
}

function shortened(path: readonly NodeId[]): PartOfPath[] {
  const first = path.length - NEAREST;
  return path.flatMap((id, at) => {
    if (at > 0 && at < first) return [];
    return { id, passed: at === first && first > 1 ? path.slice(1, first) : [] };
  });
}

/** The path to the selected block: the trees above this one, and the blocks from the root. */
export const Breadcrumbs = memo(function Breadcrumbs({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  const diagrams = useProjectStore((state) => state.diagrams);
  const main = useProjectStore((state) => state.mainTree);
  const select = useProjectStore((state) => state.select);
  const first = useProjectStore((state) => (state.activeTree === treeId ? state.selection[0] : undefined));
  const diagram = diagrams[treeId];
  const owners = useMemo(() => ownersOf(diagrams, treeId, main), [diagrams, treeId, main]);
  const path = useMemo(() => pathTo(diagram, first), [diagram, first]);
  const isBasic = useIsBasic();
  // The tab names the tree, too.
  if (isBasic && owners.length === 0 && path.length === 0) return null;
  return (
    <nav className={classes['breadcrumbs']} aria-label={t('breadcrumbs')}>
      {owners.map((owner) => (
        <Fragment key={owner}>
          <button
            type="button"
            onClick={() => {
              openTree(owner);
            }}
          >
            {owner}
          </button>
          <IconChevronRight size={13} aria-hidden="true" />
        </Fragment>
      ))}
      <button
        type="button"
        className={classes['crumbTree']}
        onClick={() => {
          select(treeId, []);
        }}
      >
        {treeId}
      </button>
      {shortened(path).map(({ id, passed }) => {
        return (
          <Fragment key={id}>
            <IconChevronRight size={13} aria-hidden="true" />
            {passed.length > 0 && (
              <>
                <span title={passed.map((each) => nameOf(diagram, each)).join(' › ')}>…</span>
                <IconChevronRight size={13} aria-hidden="true" />
              </>
            )}
            <button
              type="button"
              aria-current={id === first ? 'true' : undefined}
              onClick={() => {
                select(treeId, [id]);
              }}
            >
              {nameOf(diagram, id)}
            </button>
          </Fragment>
        );
      })}
    </nav>
  );
});
