import { ActionIcon, Tooltip } from '@mantine/core';
import { IconZoomIn, IconZoomOut } from '@tabler/icons-react';
import { useMemo, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { TreeImage } from '@/features/export/TreeImage';
import type { Diagram } from '@/model/diagram';
import { treeDifference, type TreeDifference } from '@/model/difference/changes';
import { layoutTree, type Layout } from '@/model/layout';
import { useProjectStore } from '@/store/project';
import { ChangeList, COLORS, SIGNS } from './ChangeList';
import classes from './revisions.module.css';

interface TreePictureProps {
  readonly before: Diagram;
  readonly after: Diagram;
}

const onThePage = (name: string) => `var(--bts-${name})`;

/** Both states of a tree in one picture; added, removed, changed and moved blocks are marked and listed. */
export function TreePicture({ before, after }: TreePictureProps) {
  const { t } = useTranslation('revisions');
  const vocabulary = useProjectStore((state) => state.vocabulary);
  const [isLarge, setLarge] = useState(false);
  const [chosen, setChosen] = useState<string | null>(null);
  const difference = useMemo(() => treeDifference(before, after), [before, after]);
  const layout = useMemo(
    () => layoutTree(difference.merged, vocabulary, { ignorePositions: true }),
    [difference, vocabulary],
  );
  const label = t(isLarge ? 'smaller' : 'larger');
  const Zoom = isLarge ? IconZoomOut : IconZoomIn;
  return (
    <div className={classes['pictured']}>
      {/* The list gives the same information as text. */}
      <div
        className={classes['picture']}
        data-large={isLarge || undefined}
        data-testid="picture-difference"
        aria-hidden="true"
      >
        <TreeImage diagram={difference.merged} layout={layout} vocabulary={vocabulary} palette={onThePage}>
          <Marks difference={difference} layout={layout} chosen={chosen} />
        </TreeImage>
      </div>
      <div className={classes['words']}>
        <div className={classes['legend']}>
          {difference.changes.size === 0 ? t('noBlocks') : t('blocks', { count: difference.changes.size })}
          <Tooltip label={label}>
            <ActionIcon
              size="sm"
              aria-label={label}
              aria-pressed={isLarge}
              onClick={() => setLarge(!isLarge)}
            >
              <Zoom size={16} />
            </ActionIcon>
          </Tooltip>
        </div>
        <ChangeList difference={difference} onPoint={setChosen} />
      </div>
    </div>
  );
}

interface MarksProps {
  readonly difference: TreeDifference;
  readonly layout: Layout;
  readonly chosen: string | null;
}

/** The marks: a ring and a sign around each block that differs. */
function Marks({ difference, layout, chosen }: MarksProps) {
  return [...difference.changes].map(([id, { kind }]) => {
    const box = layout.positions[id];
    if (!box) return null;
    return (
      <g key={id} transform={`translate(${box.x} ${box.y})`} data-change={kind} data-node={id}>
        <rect
          x={-5}
          y={-5}
          width={box.width + 10}
          height={box.height + 10}
          rx={14}
          fill="none"
          stroke={COLORS[kind]}
          strokeWidth={chosen === id ? 6 : 3}
          strokeDasharray={kind === 'removed' ? '7 5' : undefined}
        />
        <circle cx={box.width} cy={0} r={12} fill={COLORS[kind]} />
        <text
          x={box.width}
          y={6}
          fontSize={17}
          fontWeight={700}
          textAnchor="middle"
          fill="var(--bts-surface)"
        >
          {SIGNS[kind]}
        </text>
      </g>
    );
  });
}
