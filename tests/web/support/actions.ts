/** The store and most of its actions, for tests that use many of them. */
export * from '../../../web/ui/store/actions/files';
export * from '../../../web/ui/store/actions/model';
export * from '../../../web/ui/store/actions/reaction';
export * from '../../../web/ui/store/actions/settings';
export * from '../../../web/ui/store/store';
export * from '../../../web/ui/store/actions/notices';
export * from '../../../web/ui/store/actions/view';
