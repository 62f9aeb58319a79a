//! Names that programs may be linked with, for what is out of scope: no extension of theirs is advertised. They do
//! nothing and return 0 or NULL.

use std::ffi::c_void;
use std::ptr::null;

macro_rules! stubs {
    ($($name:ident)*) => {$(
        /// Does nothing. Callers with arguments clean them up themselves in this calling convention.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name() -> *const c_void {
            null()
        }
    )*};
}

stubs! {
    glXAllocateMemoryNV glXBindChannelToWindowSGIX glXBindHyperpipeSGIX glXBindSwapBarrierNV
    glXBindSwapBarrierSGIX glXBindTexImageEXT glXBindVideoCaptureDeviceNV glXBindVideoDeviceNV glXBindVideoImageNV
    glXBlitContextFramebufferAMD glXChannelRectSGIX glXChannelRectSyncSGIX glXCopyBufferSubDataNV
    glXCopyImageSubDataNV glXCopySubBufferMESA glXCreateAssociatedContextAMD
    glXCreateAssociatedContextAttribsAMD glXCreateGLXPixmapMESA glXCushionSGI glXDelayBeforeSwapNV
    glXDeleteAssociatedContextAMD glXDestroyHyperpipeConfigSGIX glXEnumerateVideoCaptureDevicesNV
    glXEnumerateVideoDevicesNV glXFreeMemoryNV glXGetAGPOffsetMESA glXGetContextGPUIDAMD
    glXGetCurrentAssociatedContextAMD glXGetDriverConfig glXGetGPUIDsAMD glXGetGPUInfoAMD glXGetMscRateOML
    glXGetRefreshRateSGI glXGetScreenDriver glXGetSyncValuesOML glXGetTransparentIndexSUN glXGetVideoDeviceNV
    glXGetVideoInfoNV glXGetVideoSyncSGI glXHyperpipeAttribSGIX glXHyperpipeConfigSGIX glXImportContextEXT
    glXJoinSwapGroupNV glXJoinSwapGroupSGIX glXLockVideoCaptureDeviceNV glXMakeAssociatedContextCurrentAMD
    glXNamedCopyBufferSubDataNV glXQueryChannelDeltasSGIX glXQueryChannelRectSGIX
    glXQueryCurrentRendererIntegerMESA glXQueryCurrentRendererStringMESA glXQueryFrameCountNV
    glXQueryHyperpipeAttribSGIX glXQueryHyperpipeBestAttribSGIX glXQueryHyperpipeConfigSGIX
    glXQueryHyperpipeNetworkSGIX glXQueryMaxSwapBarriersSGIX glXQueryMaxSwapGroupsNV
    glXQueryRendererIntegerMESA glXQueryRendererStringMESA glXQuerySwapGroupNV glXQueryVideoCaptureDeviceNV
    glXReleaseBuffersMESA glXReleaseTexImageEXT glXReleaseVideoCaptureDeviceNV glXReleaseVideoDeviceNV
    glXReleaseVideoImageNV glXResetFrameCountNV glXSendPbufferToVideoNV glXSet3DfxModeMESA glXSwapBuffersMscOML
    glXWaitForMscOML glXWaitForSbcOML glXWaitVideoSyncSGI
}
