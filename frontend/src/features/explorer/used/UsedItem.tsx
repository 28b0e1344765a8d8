import { ActionIcon, Menu, Tooltip } from '@mantine/core';
import {
  IconCopy,
  IconDots,
  IconPencil,
  IconRobot,
  IconSwitchHorizontal,
  IconWorld,
} from '@tabler/icons-react';
import { useState, type MouseEvent } from 'react';
import { useTranslation } from 'react-i18next';
import { nameIn, titleOf } from '@/model/document/glance';
import { openRobotChooser, openUniverseChooser } from '@/store/dialogs/universeChooser';
import { useFileText } from '@/store/saving/large';
import { openFile } from '@/store/project/navigation';
import classes from '../explorer.module.css';
import { isOutside, type InUse } from './inUse';
import { canCopy, makeOwnCopy, useCopying } from './ownCopy';

/** Returns the title of a used document: its own, or our title of a built-in one in the page's language. */
function useTitle(used: InUse): string {
  const { t } = useTranslation('worlds');
  const own = useFileText(used.path);
  if (used.path !== null) return nameIn(own ?? '') ?? used.id;
  if (isOutside(used)) return t('universe:outside');
  return t(`${used.kind}.${used.id}.name`, { defaultValue: titleOf(used.id) });
}

/** The row of the universe or the robot that the project uses, with commands to open, change or copy it. */
export function UsedItem({ used }: { readonly used: InUse }) {
  const { t } = useTranslation('frame');
  const [isMenuOpen, setMenuOpen] = useState(false);
  const isBusy = useCopying(({ kind }) => kind === used.kind);
  const name = useTitle(used);
  const { kind, path } = used;
  const Icon = kind === 'universe' ? IconWorld : IconRobot;
  const isCopyable = canCopy(used);
  const change = kind === 'universe' ? openUniverseChooser : openRobotChooser;
  const copy = () => void makeOwnCopy(kind);
  const origin = t(
    `explorer.used.${path !== null ? 'own' : isOutside(used) ? 'outside' : used.isOfUniverse ? 'ofUniverse' : 'builtIn'}`,
  );

  // Shift+F10 and the menu key cause the same event.
  const onContextMenu = (event: MouseEvent) => {
    event.preventDefault();
    setMenuOpen(true);
  };

  return (
    <div className={classes['item']}>
      <button
        type="button"
        className={classes['open']}
        data-testid={`used-${kind}`}
        title={t(path === null ? `explorer.used.change.${kind}` : 'explorer.open')}
        onContextMenu={onContextMenu}
        onClick={() => (path === null ? change() : openFile(path))}
      >
        <Icon size={16} stroke={1.6} aria-hidden="true" />
        <span className={classes['used']}>
          <span className={classes['name']}>{name}</span>
          <span className={classes['origin']}>{origin}</span>
        </span>
      </button>
      <Tooltip label={t(`explorer.used.change.${kind}`)}>
        <ActionIcon
          size="sm"
          aria-label={t(`explorer.used.change.${kind}`)}
          data-testid={`change-${kind}`}
          onClick={change}
        >
          <IconSwitchHorizontal size={15} />
        </ActionIcon>
      </Tooltip>
      {isCopyable ? (
        <Tooltip label={t('explorer.used.copy')}>
          <ActionIcon
            size="sm"
            aria-label={t('explorer.used.copyOf', { name })}
            data-testid={`copy-${kind}`}
            loading={isBusy}
            onClick={copy}
          >
            <IconCopy size={15} />
          </ActionIcon>
        </Tooltip>
      ) : null}
      <Menu position="bottom-end" opened={isMenuOpen} onChange={setMenuOpen}>
        <Menu.Target>
          <ActionIcon size="sm" className={classes['more']} aria-label={t('explorer.moreFor', { name })}>
            <IconDots size={15} />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          {path === null ? null : (
            <Menu.Item leftSection={<IconPencil size={16} />} onClick={() => openFile(path)}>
              {t('explorer.open')}
            </Menu.Item>
          )}
          <Menu.Item leftSection={<IconSwitchHorizontal size={16} />} onClick={change}>
            {t(`explorer.used.change.${kind}`)}
          </Menu.Item>
          {isCopyable ? (
            <Menu.Item disabled={isBusy} leftSection={<IconCopy size={16} />} onClick={copy}>
              {t('explorer.used.copy')}
            </Menu.Item>
          ) : null}
        </Menu.Dropdown>
      </Menu>
    </div>
  );
}
