import { useTranslation } from 'react-i18next';
import { displayName, type DiagramNode, type NodeId } from '@/model/diagram';
import { setComment, setName } from '@/model/edits';
import { change } from '@/store/project/commands';
import { setEditor, useEditorStore } from '@/store/project/editor';
import { BlockBadges } from './BlockBadges';
import classes from './Block.module.css';

interface BlockTitleProps {
  readonly id: NodeId;
  readonly node: DiagramNode;
}

/** Name and type, and the field in which F2 and `/` edit name and comment. */
export function BlockTitle({ id, node }: BlockTitleProps) {
  const { t } = useTranslation('canvas');
  const field = useEditorStore((state) => (state.editing?.node === id ? state.editing.field : null));
  const name = displayName(node);
  const hasBadges = node.comment !== undefined || node.conditions !== undefined;

  const finish = (text: string | null): void => {
    setEditor({ editing: null });
    if (text === null || field === null) return;
    if (field === 'name') change('rename', [setName(id, text)]);
    else change('comment', [setComment(id, text)]);
  };

  return (
    <div className={classes['titles']}>
      {field === null ? (
        <>
          <span className={classes['name']}>{name}</span>
          {(name !== node.type || hasBadges) && (
            <span className={classes['subtitle']}>
              {name !== node.type && <span className={classes['type']}>{node.type}</span>}
              <BlockBadges node={node} />
            </span>
          )}
        </>
      ) : (
        <input
          className={`${classes['rename']} nodrag nopan`}
          aria-label={t(field === 'name' ? 'rename' : 'comment')}
          placeholder={t(field === 'name' ? 'rename' : 'comment')}
          defaultValue={field === 'name' ? name : (node.comment ?? '')}
          ref={(input) => {
            input?.focus();
            input?.select();
          }}
          onBlur={(event) => {
            finish(event.currentTarget.value);
          }}
          onKeyDown={(event) => {
            event.stopPropagation();
            if (event.key === 'Enter') finish(event.currentTarget.value);
            if (event.key === 'Escape') finish(null);
          }}
        />
      )}
    </div>
  );
}
