import type { TFunction } from 'i18next';
import { Fragment, type CSSProperties } from 'react';
import { displayName, type DiagramNode, type NodeId } from '@/model/diagram';
import { setComment, setName } from '@/model/edits';
import { change } from '@/store/project/edits/blocks';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { BlockBadges } from './BlockBadges';
import { wordsOf } from './words';
import { TextField } from './TextField';
import classes from './Block.module.css';

interface BlockTitleProps {
  readonly id: NodeId;
  readonly node: DiagramNode;
  readonly t: TFunction<'canvas'>;
}

/** The name of a block. When zoomed out, it has up to two lines, which break only between words. */
function BlockName({ name }: { readonly name: string }) {
  const words = wordsOf(name);
  const longest = Math.max(...words.map((word) => word.trim().length));
  return (
    <span className={classes['name']} style={{ '--longest': longest } as CSSProperties}>
      {words.map((word, index) => (
        <Fragment key={index}>
          {index > 0 && <wbr />}
          {word}
        </Fragment>
      ))}
    </span>
  );
}

/** The name and type of a block; F2 and `/` edit the name and the comment here. */
export function BlockTitle({ id, node, t }: BlockTitleProps) {
  const field = useEditorStore((state) => (state.editing?.node === id ? state.editing.field : null));
  const name = displayName(node);
  const hasBadges = node.comment !== undefined || node.conditions !== undefined;

  const finish = (text: string): void => {
    setEditor({ editing: null });
    if (field === null) return;
    if (field === 'name') change('rename', [setName(id, text)]);
    else change('comment', [setComment(id, text)]);
  };

  return (
    <div className={classes['titles']}>
      {field === null ? (
        <>
          <BlockName name={name} />
          {(name !== node.type || hasBadges) && (
            <span className={classes['subtitle']}>
              {name !== node.type && <span className={classes['type']}>{node.type}</span>}
              <BlockBadges node={node} />
            </span>
          )}
        </>
      ) : (
        <TextField
          label={t(field === 'name' ? 'rename' : 'comment')}
          initial={field === 'name' ? name : (node.comment ?? '')}
          onFinish={finish}
        />
      )}
    </div>
  );
}
