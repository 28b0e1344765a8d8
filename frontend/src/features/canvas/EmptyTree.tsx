import { Button } from '@mantine/core';
import { IconPlus } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { FamilyTile } from '@/ui/FamilyTile';
import { openQuickAdd } from './quickAdd/open';
import classes from './Canvas.module.css';

/** The hint on an empty canvas: how to add the first block. */
export function EmptyTree({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  return (
    <div className={classes['empty']}>
      <div className={classes['emptyTiles']}>
        <FamilyTile type="Sequence" family="control" size={40} />
        <FamilyTile type="Inverter" family="decorator" size={40} />
        <FamilyTile type="" family="condition" size={40} />
        <FamilyTile type="" family="action" size={40} />
      </div>
      <strong>{t('empty.title')}</strong>
      <p>{t('empty.text')}</p>
      <Button
        leftSection={<IconPlus size={16} aria-hidden="true" />}
        onClick={(event) => {
          const box = event.currentTarget.getBoundingClientRect();
          openQuickAdd(treeId, { does: 'add', place: { at: 'root' } }, box.left - 80, box.bottom + 8);
        }}
      >
        {t('empty.button')}
      </Button>
    </div>
  );
}
