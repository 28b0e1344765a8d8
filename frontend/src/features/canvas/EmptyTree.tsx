import { IconPlus } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { useEditorStore } from '@/store/project/editor';
import { openQuickAdd } from './quickAdd/open';
import classes from './Canvas.module.css';

/** The place of the first block of an empty tree: a click, a key or a dropped block starts the tree there. */
export function EmptyTree({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  const isDragged = useEditorStore((state) => state.dragged !== null);
  return (
    <div className={classes['empty']}>
      <button
        type="button"
        className={classes['ghostRoot']}
        data-testid="ghost-block"
        data-target={isDragged || undefined}
        onClick={(event) => {
          const box = event.currentTarget.getBoundingClientRect();
          openQuickAdd(treeId, { does: 'add', place: { at: 'root' } }, box.left, box.bottom + 8);
        }}
      >
        <span>
          <IconPlus size={22} aria-hidden="true" />
        </span>
        {t('empty.ghost')}
      </button>
      <p>{t('empty.text')}</p>
    </div>
  );
}
