import catalog from '@catalog';
import { memo, useMemo } from 'react';
import { parseDiagram } from '@/model/serialize';
import { childrenOf, type Diagram, type DiagramNode } from '@/model/diagram';
import { layoutTree, type Box, type Layout } from '@/model/layout';
import { makeVocabulary, readCatalog, specOf, type Family } from '@/model/vocabulary';
import { isInside, pictureFrame } from './pictureFrame';
import classes from './projects.module.css';

interface TreePictureProps {
  readonly diagram: unknown;
  /** Types that are conditions according to the project's own code. */
  readonly conditions?: readonly string[] | undefined;
}

const vocabulary = makeVocabulary(readCatalog(catalog));

interface Picture {
  diagram: Diagram;
  layout: Layout;
}

function read(document: unknown): Picture | null {
  try {
    const diagram = parseDiagram(document);
    const layout = layoutTree(diagram, vocabulary, { ignorePositions: true });
    return layout.width > 0 ? { diagram, layout } : null;
  } catch {
    // The diagram has an error, which is reported when the project is opened; the card shows no picture.
    return null;
  }
}

function edgePath(from: Box, to: Box, isVertical: boolean): string {
  const start = isVertical
    ? [from.x + from.width / 2, from.y + from.height]
    : [from.x + from.width, from.y + from.height / 2];
  const end = isVertical ? [to.x + to.width / 2, to.y] : [to.x, to.y + to.height / 2];
  const [x1 = 0, y1 = 0] = start;
  const [x2 = 0, y2 = 0] = end;
  const middle = isVertical ? (y1 + y2) / 2 : (x1 + x2) / 2;
  return isVertical
    ? `M${x1} ${y1}C${x1} ${middle} ${x2} ${middle} ${x2} ${y2}`
    : `M${x1} ${y1}C${middle} ${y1} ${middle} ${y2} ${x2} ${y2}`;
}

function familyOf(node: DiagramNode | undefined, conditions: readonly string[] = []): Family {
  if (!node) return 'action';
  return specOf(vocabulary, node)?.family ?? (conditions.includes(node.type) ? 'condition' : 'action');
}

/** A small picture of a tree with shapes and colours only; for a large tree, only the top. */
export const TreePicture = memo(function TreePicture({ diagram: document, conditions }: TreePictureProps) {
  const picture = useMemo(() => read(document), [document]);
  const root = picture && picture.layout.positions[picture.diagram.root ?? ''];
  if (!picture || !root) return <div className={classes['noPicture']} aria-hidden="true" />;
  const { diagram, layout } = picture;
  const isVertical = diagram.layout === 'vertical';
  const frame = pictureFrame(Object.values(layout.positions), root, isVertical);
  const boxes = Object.entries(layout.positions).filter(([, box]) => isInside(frame, box));
  return (
    <svg
      className={classes['picture']}
      viewBox={`${frame.x} ${frame.y} ${frame.width} ${frame.height}`}
      aria-hidden="true"
      preserveAspectRatio="xMidYMid meet"
      data-cropped={frame.cropped ?? undefined}
    >
      {boxes.flatMap(([id, box]) =>
        childrenOf(diagram, id).map((child) => {
          const to = layout.positions[child];
          return to ? (
            <path
              key={`${id}-${child}`}
              d={edgePath(box, to, isVertical)}
              className={classes['pictureEdge']}
            />
          ) : null;
        }),
      )}
      {boxes.map(([id, box]) => {
        const family = familyOf(diagram.nodes[id], conditions);
        return (
          <rect
            key={id}
            x={box.x}
            y={box.y}
            width={box.width}
            height={box.height}
            rx={family === 'condition' ? box.height / 2 : 10}
            fill={`var(--bts-${family})`}
          />
        );
      })}
    </svg>
  );
});
